"""The tornado plot: what moves T_max, A_T and the friction force, the strongest first."""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis import MEASURED_TO_K
from validation.drawing import BLUE, GREY, PAGE_WIDTH, VERMILLION, new_figure, styled
from validation.sensitivity.parameters import NUMERICS, PARAMETERS, PHYSICS, first_key

PANELS = {
    "T_max_difference_K": "change of $T_{max}$ [K]",
    "A_T_difference_percent": "change of $A_T$ [%]",
    "friction_force_difference_percent": "change of $F_T$ [%]",
}
HEADINGS = {
    PHYSICS: "Left open by the paper",
    NUMERICS: "Numerics: should not matter",
}
COLOURS = {PHYSICS: BLUE, NUMERICS: VERMILLION}
#: How many times longer than the next one a bar must be to be cut.
OUTLIER = 4.0
_ROW_MM, _AROUND_MM = 4.6, 24.0
_BAR = 0.68


@dataclass(frozen=True)
class _Line:
    """A line of the picture: a heading (`row` is None) or a bar with the words before it.

    `first` is true for the first of the values of a parameter.
    """

    text: str
    group: str
    row: pd.Series | None = None
    first: bool = False


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw a bar per case of the study's table in three panels that share their lines."""
    lines = _lines(by_influence(table))
    figure = new_figure(PAGE_WIDTH, _AROUND_MM + _ROW_MM * len(lines))
    panels = figure.subplots(1, len(PANELS), sharey=True)
    for axes, (column, title) in zip(panels, PANELS.items(), strict=True):
        _draw_panel(axes, lines, column)
        axes.set_xlabel(title)
    panels[0].axvspan(-MEASURED_TO_K[1], MEASURED_TO_K[1], color="#EEEEEE", lw=0, zorder=0)
    panels[0].set_yticks(range(len(lines)), [line.text for line in lines], fontsize=7.0)
    for label, line in zip(panels[0].get_yticklabels(), lines, strict=True):
        if line.row is None:
            label.set(fontweight="bold", color=COLOURS[line.group])
    base = table.iloc[0]
    figure.suptitle(_heading(base), fontsize=8.5, fontweight="bold", x=0.01, ha="left")
    note = f"grey band: ±{MEASURED_TO_K[1]:g} K, to which the paper's temperatures were measured"
    if any(_is_cut(table[column]) for column in PANELS):
        note = f"arrow: the bar is longer than shown; {note}"
    figure.supxlabel(note, fontsize=7.0, color=GREY, x=0.99, ha="right")
    return figure


def by_influence(table: pd.DataFrame) -> pd.DataFrame:
    """Rows without the base: physics before numerics, what moves T_max most first.

    The values of a parameter stay together; those that cannot be compared come last.
    """
    rows = table[table["group"].isin(HEADINGS)]
    size = rows["T_max_difference_K"].abs().groupby(rows["parameter"]).transform("max")
    keys = rows.assign(
        _group=rows["group"].map(list(HEADINGS).index), _size=-size, _order=np.arange(len(rows))
    )
    first = keys.groupby("parameter")["_order"].transform("min")
    keys = keys.assign(_first=first).sort_values(["_group", "_size", "_first", "_order"])
    return rows.loc[keys.index]


def _lines(rows: pd.DataFrame) -> list[_Line]:
    lines: list[_Line] = []
    before = ""
    for _, row in rows.iterrows():
        if not any(line.group == row["group"] for line in lines):
            lines.append(_Line(HEADINGS[row["group"]], row["group"]))
        first = row["parameter"] != before
        to = f"→ {row['to']} {PARAMETERS[first_key(row['parameter'])].unit}".strip()
        words = f"{row['label']}: {row['from']} {to}" if first else to
        lines.append(_Line(words, row["group"], row, first))
        before = row["parameter"]
    return lines


def _draw_panel(axes: Axes, lines: list[_Line], column: str) -> None:
    values = [0.0 if line.row is None else float(line.row[column]) for line in lines]
    known = np.array([0.0, *(value for value in values if not np.isnan(value))])
    longest = limit(known)
    shown = np.clip(known, -longest, longest)
    room = (0.42 if longest == np.abs(known).max() else 0.55) * max(np.ptp(shown), 1e-6)
    low, high = shown.min() - room, shown.max() + room
    axes.set_xlim(low, high)
    for place, (line, value) in enumerate(zip(lines, values, strict=True)):
        if line.first:
            axes.axhline(place - 0.5, color="#DDDDDD", lw=0.5, zorder=0.5)
        if line.row is not None and np.isnan(value):
            _say_where_it_stopped(axes, place, float(line.row["reached_mm"]))
        elif line.row is not None:
            _draw_bar(axes, place, value, COLOURS[line.group], longest)
    axes.axvline(0.0, color="black", lw=0.6)
    axes.set_ylim(len(lines) - 0.4, -0.6)
    axes.tick_params(axis="y", length=0, pad=6.0)
    axes.spines["left"].set_visible(False)
    axes.grid(True, axis="x")
    axes.set_axisbelow(True)


def _draw_bar(axes: Axes, place: int, value: float, colour: str, longest: float) -> None:
    """Draw a bar with its value outside its end; one that is too long ends in an arrow."""
    end = float(np.clip(value, -longest, longest))
    axes.barh(place, end, height=_BAR, color=colour, lw=0)
    left = value < 0.0
    if end != value:
        axes.plot(end, place, marker="<" if left else ">", color=colour, ms=7.0, clip_on=False)
    beside = (-2.0 if left else 2.0) * (1.0 if end == value else 2.5)
    look = {"ha": "right" if left else "left", "va": "center", "fontsize": 6.5}
    offset = {"xytext": (beside, 0.0), "textcoords": "offset points"}
    axes.annotate(signed(value), (end, place), **offset, **look)


def limit(values: np.ndarray) -> float:
    """Longest bar: one that is many times longer than all others would make them unreadable."""
    sizes = np.sort(np.abs(values))
    if len(sizes) > 1 and sizes[-1] > OUTLIER * sizes[-2]:
        return float(1.25 * sizes[-2]) or float(sizes[-1])
    return float(sizes[-1])


def _is_cut(values: pd.Series) -> bool:
    known = values.dropna().to_numpy(dtype=float)
    return bool(len(known)) and limit(known) < np.abs(known).max()


def _say_where_it_stopped(axes: Axes, place: int, reached_mm: float) -> None:
    words = f"stopped at {reached_mm:.3g} mm"
    look = {"color": GREY, "fontsize": 6.0, "ha": "center", "va": "center"}
    box = {"fc": "white", "ec": "none", "pad": 0.8}
    axes.text(0.5, place, words, transform=axes.get_yaxis_transform(), bbox=box, **look)


def _heading(base: pd.Series) -> str:
    if base["status"] != "ok":
        return f"the base did not get to its end (stopped at {base['reached_mm']:.3g} mm)"
    return (
        f"One at a time, from $T_{{max}}$ = {base['T_max_C']:.1f} °C, "
        f"$A_T$ = {base['A_T_K_mm']:.0f} K mm, "
        f"$F_T$ = {base['friction_force_N_per_mm']:.2f} N/mm"
    )


def signed(value: float) -> str:
    """Show a change with its sign and a true minus: two digits after the point below ten."""
    if abs(value) < 0.005:
        return "0.00"
    return f"{value:+.{2 if abs(value) < 9.995 else 1}f}".replace("-", "−")
