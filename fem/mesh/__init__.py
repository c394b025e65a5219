"""The mesh of the block and the node sets of its boundary."""
