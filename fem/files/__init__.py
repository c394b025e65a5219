"""Files, streams and signals: what a run has to do with the machine, and nothing of physics."""
