"""The same case in CalculiX: input decks, runs and their comparison."""

from validation.calculix.export_deck import DeckOptions, friction_remark, slab_layers, write_deck
