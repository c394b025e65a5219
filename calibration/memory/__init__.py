"""Fits of what rubber remembers: relaxation times and softening."""
