"""The paper's figures, tables and claims, and the pictures of a run."""
