"""What the paper leaves open and what it should not depend on: one parameter at a time."""

from validation.sensitivity.parameters import PARAMETERS, Parameter, first_key
