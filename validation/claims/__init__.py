"""The paper's checkable statements, each against our own numbers: the ledger of claims."""
