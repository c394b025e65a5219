"""Study files of the paper's figures and tables."""
