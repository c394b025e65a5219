"""A case computed here and by CalculiX, side by side.

The deck is quasi-static: a case with ``inertia = false`` and ``viscous_distance_mm = 0`` has the
same physics on both sides. What differs then are elements (mean dilatation against one-point
integration), contact (exact against penalty) and the size of the increments. Inertia and the
damping of snaps, which acts on steps without a solution only, add little: with the default
settings, a 20 mm x 10 mm block, 10 mm/s and constant friction 0.3, all differences stay below
0.7 %.

What was found with version 2.20 and Yeoh rubber (blocks of the tests, 20 mm x 8 mm):

- Constant friction 0.3: force, platen and contact length agree to 2 % at every step. Most of what
  there is comes from the 0.1 mm increments of the deck: with 0.02 mm the friction force agrees to
  0.1 % instead of 1.2 %. The contact length jumps by a cell when a node lifts off, so codes that
  see it lift off a step apart differ by a cell for that step. The platen differs by 0.3 to 0.6 %.
- Constant friction 0.6: the same holds for about 1 mm, until the leading edge rolls under and
  snaps through. The folded edge, two or three cells of 0.5 mm, then has several positions of
  equilibrium: here the contact length ends at 16.95 mm or at 17.24 mm, depending on the steps (and
  at 17.24 mm with inertia or a little viscosity), in CalculiX at 14.76 mm with the corner drawn
  further under. C3D8I, surface-to-surface contact and a finer mesh make CalculiX break off on the
  way there. Past the snap, the two codes cannot be compared.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd

from fem import simulate
from fem.case.case import Case
from fem.results.result import Result
from validation.calculix.deck_results import deck_history, read_dat
from validation.calculix.deck_run import run_calculix
from validation.calculix.export_deck import DeckOptions, write_deck

#: Columns compared while the block is pressed (against the force) and while it slides.
PRESSING_COLUMNS = ("platen_displacement_mm", "contact_length_mm")
SLIDING_COLUMNS = ("platen_displacement_mm", "contact_length_mm", "friction_force_N_per_mm")


def compare_with_calculix(
    case: Case,
    folder: str | Path,
    options: DeckOptions | None = None,
    *,
    timeout_s: float = 600.0,
) -> pd.DataFrame:
    """Compute a case both ways and compare the histories.

    Parameters
    ----------
    case : Case
        A case that can be exported.
    folder : str or Path
        Existing folder for the deck and what CalculiX writes.
    options : DeckOptions, optional
    timeout_s : float
        Longest run time of CalculiX [s].

    Returns
    -------
    DataFrame
        See `compared`.
    """
    deck = write_deck(case, Path(folder) / "deck.inp", options)
    theirs = deck_history(case, read_dat(run_calculix(deck, timeout_s=timeout_s)))
    return compared(simulate(case), theirs)


def compared(result: Result, theirs: pd.DataFrame) -> pd.DataFrame:
    """Compare a result with the history of its deck, at our accepted steps.

    Parameters
    ----------
    result : Result
        Our run.
    theirs : DataFrame
        From `deck_history`; interpolated linearly, in the force while the block is pressed and in
        the distance while it slides.

    Returns
    -------
    DataFrame
        ``phase, coordinate, quantity, ours, calculix, relative_difference``: the coordinate is
        the normal force [N/mm] or the sliding distance [mm]; the difference is relative to the
        largest value of the quantity in our run.
    """
    ours = result.history
    pressed = ours["sliding_distance_mm"] <= 0.0
    pressed_theirs = theirs["sliding_distance_mm"] <= 0.0
    force, distance = "normal_force_N_per_mm", "sliding_distance_mm"
    parts = [
        _phase("pressing", force, PRESSING_COLUMNS, ours[pressed], theirs[pressed_theirs]),
        _phase("sliding", distance, SLIDING_COLUMNS, ours[~pressed], theirs[~pressed_theirs]),
    ]
    table = pd.concat([part for part in parts if len(part)], ignore_index=True)
    scale = table.groupby("quantity")["ours"].transform(lambda values: values.abs().max())
    table["relative_difference"] = (table["calculix"] - table["ours"]) / scale
    return table


def _phase(
    name: str, coordinate: str, columns: tuple[str, ...], ours: pd.DataFrame, theirs: pd.DataFrame
) -> pd.DataFrame:
    """Rows of one phase; where CalculiX did not get to, there is nothing to compare."""
    if theirs.empty:
        return pd.DataFrame()
    at = theirs[coordinate].to_numpy()
    slack = 1e-6 * float(at.max())
    reached = ours[ours[coordinate].between(at.min() - slack, at.max() + slack)]
    x = reached[coordinate].to_numpy()
    return pd.concat(
        [
            pd.DataFrame(
                {
                    "phase": name,
                    "coordinate": x,
                    "quantity": column,
                    "ours": reached[column].to_numpy(),
                    "calculix": np.interp(x, at, theirs[column].to_numpy()),
                }
            )
            for column in columns
        ],
        ignore_index=True,
    )


def largest_differences(table: pd.DataFrame) -> pd.Series:
    """Largest relative difference of each phase and quantity, from `compared`."""
    return table["relative_difference"].abs().groupby([table["phase"], table["quantity"]]).max()
