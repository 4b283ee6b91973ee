"""What a chain model is and which there are."""
