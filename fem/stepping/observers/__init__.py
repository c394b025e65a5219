"""What looks at every accepted step, each thing in its own file, in the order of `RunObservers`."""
