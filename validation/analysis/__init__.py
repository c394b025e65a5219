"""What the tables and fields of finished runs tell: pure functions that claims, figures and
sensitivity share."""
