"""How the parameter sets of Table 1 are written in figures and tables, and drawn."""

from dataclasses import dataclass
from typing import Any

from validation.drawing.style import CURVES, DASHES, MARKERS


@dataclass(frozen=True, kw_only=True)
class CompoundLook:
    """Label, colour, dash and marker of a parameter set."""

    label: str
    colour: str
    dash: Any
    marker: str


_LABELS = {
    "van-der-waals-bars-series-1": "van der Waals, bars, series 1",
    "van-der-waals-bars-series-2": "van der Waals, bars, series 2",
    "yeoh-bars-series-1": "Yeoh, bars, series 1",
    "yeoh-bars-series-2": "Yeoh, bars, series 2",
    "yeoh-bars-series-1-load": "Yeoh, bars, series 1, load",
    "mooney-rivlin-dumbbells": "Mooney-Rivlin, dumbbells",
}

#: In the order of the paper's Fig. 9.
COMPOUND_LOOKS = {
    name: CompoundLook(label=label, colour=CURVES[i], dash=DASHES[i], marker=MARKERS[i])
    for i, (name, label) in enumerate(_LABELS.items())
}
