"""Sparse linear systems: pattern, elimination order, factorisation, iteration."""
