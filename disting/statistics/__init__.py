"""How much the lines of a measured response scatter, and how their residuals hang together."""
