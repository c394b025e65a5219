"""Measured tables: from bytes to checked rows, with an account of what became of each."""
