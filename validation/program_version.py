"""Which program made a result (the runs of a sweep have to be of one program)."""

from fem.program_version import program_version

__all__ = ["program_version"]
