"""The paper's checkable statements, each against our own numbers: the ledger of claims.

In the modules of the paper's sections a function has the key of its statement in
`statements.toml`; it returns the numbers of the ledger, and what else comparisons and texts name.
"""
