"""How results are drawn: style, fields on the block, curves of a run."""
