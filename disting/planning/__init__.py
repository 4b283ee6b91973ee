"""What further measuring would show: its power against a rival, and which experiment is next."""
