"""One HTML page of everything that was computed, to be mailed."""
