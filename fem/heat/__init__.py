"""Heat in the block and the road, exchanged between them and radiated."""
