"""Case, mesh, mechanics, heat, stepping and results of the sliding tread block."""

from fem.case.case import Case
from fem.simulate import simulate

__all__ = ["Case", "simulate"]
