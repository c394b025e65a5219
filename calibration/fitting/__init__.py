"""The least-squares core that all fits share, and the parameter file they write."""
