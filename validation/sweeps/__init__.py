"""Studies and sweeps: many cases, in parallel, resumable."""
