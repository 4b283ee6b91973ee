"""Gröbner bases modulo primes and over the rational numbers, and what is read off them."""
