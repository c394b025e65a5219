"""What a run leaves: tables, fields, checkpoints, how it ended, how far it can be trusted."""
