"""The same case in CalculiX: input decks, runs and their comparison."""
