"""The same case in CalculiX: input decks, runs and their comparison."""

from validation.calculix.export_deck import friction_remark, write_deck
