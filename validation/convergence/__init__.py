"""To the limit: what the results depend on that they should not depend on."""
