"""Identification of the heat partition by resimulating sliding blocks."""
