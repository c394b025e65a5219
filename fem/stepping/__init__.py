"""From the programme to accepted steps and their records, for soft and for rigid blocks."""
