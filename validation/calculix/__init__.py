"""The same case in CalculiX: input decks, runs and their comparison."""

from validation.calculix.deck_event import PRESSING_TIME
from validation.calculix.deck_mesh import Layers, half_slab
from validation.calculix.deck_results import DatTable, deck_history, read_dat
from validation.calculix.deck_run import CalculixError, calculix_program, run_calculix
from validation.calculix.export_deck import (
    DeckOptions,
    friction_remark,
    input_deck,
    normal_stiffness,
    slab_layers,
    write_deck,
)
