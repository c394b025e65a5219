"""The case: what a simulation needs to know, read from TOML, checked, frozen, written again."""
