"""The reference: every public name and every command, read off the code itself."""
