"""What a chain model is and which there are; what every family of models offers (`protocol`)."""
