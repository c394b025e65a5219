"""One look for all figures: sizes, fonts, colours; written the same way every time.

Figures are drawn on matplotlib's Agg canvas directly, without pyplot: no window, no global state.
"""

from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from fem.files import replacing

_P = ParamSpec("_P")
_R = TypeVar("_R")

MM_PER_INCH = 25.4
#: Width of a figure across a page [mm].
PAGE_WIDTH = 180.0
RESOLUTION = 200

#: Okabe and Ito's palette, which colour-blind readers can tell apart (Nature Methods 8 (2011) 441).
BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
BLUE, VERMILLION, PURPLE = "#0072B2", "#D55E00", "#CC79A7"
CURVES = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY)
DASHES = ("-", "--", "-.", ":", (0, (6, 1, 1, 1, 1, 1)), (0, (3, 1)))
MARKERS = ("o", "s", "^", "D", "v", "P")
GREY = "#707070"
ROAD_GREY = "#D8D4CE"
RUBBER_GREY = "#E9EEF3"

#: Even in lightness, readable in print and by colour-blind readers; cold rubber stays light.
TEMPERATURE_MAP = "YlOrRd"
STRESS_MAP = "viridis"

RC: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 8.0,
    "axes.titlesize": 8.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 8.0,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.useoffset": False,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "legend.fontsize": 7.5,
    "legend.frameon": False,
    "lines.linewidth": 1.3,
    "lines.markersize": 4.0,
    "hatch.linewidth": 0.5,
    "savefig.dpi": RESOLUTION,
    "figure.dpi": RESOLUTION,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.5,
    "mathtext.fontset": "dejavusans",
}


def styled(draw: Callable[_P, _R]) -> Callable[_P, _R]:
    """Run a drawing function with this style, whatever the caller's matplotlib settings are."""

    @wraps(draw)
    def with_style(*args: _P.args, **kwargs: _P.kwargs) -> _R:
        with matplotlib.rc_context():
            matplotlib.rcdefaults()
            matplotlib.rcParams.update(RC)
            return draw(*args, **kwargs)

    return with_style


def new_figure(width_mm: float, height_mm: float, *, layout: str = "constrained") -> Figure:
    """Make an empty figure of a size in mm."""
    figure = Figure(figsize=(width_mm / MM_PER_INCH, height_mm / MM_PER_INCH), layout=layout)
    FigureCanvasAgg(figure)
    return figure


@styled
def save(figure: Figure, path: str | Path) -> Path:
    """Write a PNG; equal figures give equal files (no date, no program version inside)."""
    path = Path(path)
    with replacing(path) as temporary:
        figure.savefig(temporary, format="png", dpi=RESOLUTION, metadata={"Software": None})
    return path
