"""The paper's figures, tables and claims, and the pictures of a run."""

from validation.commands import add_arguments
