"""Mechanics of the block: elements, one implicit step with the road, damping of snaps."""
