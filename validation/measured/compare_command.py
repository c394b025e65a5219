"""The comparison of a file of measurements with a folder of results, as files and as text."""

import math
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from fem.files import spreadsheet, write_text
from validation.drawing import save
from validation.measured.comparison import Comparison, compare
from validation.measured.comparison_figures import draw_comparison, draw_profiles
from validation.measured.measurements import read_measurements
from validation.measured.simulated import simulated_runs

#: Tests without a simulation that are named.
_MOST_NAMES = 20


@dataclass(frozen=True, kw_only=True)
class Report:
    """What a comparison has to say.

    Attributes
    ----------
    text : str
        Statistics to print.
    notes : tuple of str
        How the measurements were understood and compared.
    unusual : tuple of str
        Numbers of the measurements outside their usual range.
    """

    text: str
    notes: tuple[str, ...]
    unusual: tuple[str, ...]


def write_comparison(
    measured: str | Path, results: str | Path, directory: str | Path, *, pyrometer: bool = False
) -> Report:
    """Compare, write the tables and pictures into a folder, and return what is to be printed.

    Parameters
    ----------
    measured : str or Path
        CSV file of measurements, see `validation.measured.measurements`.
    results : str or Path
        Folder of a sweep or of a run.
    directory : str or Path
        For `comparison.csv`, `statistics.csv`, `measured.csv` (T_max and A_T of each test),
        `comparison.log` (what is said), `comparison.png` and, for measured profiles,
        `profiles.png`.
    pyrometer : bool
        Whether temperatures are those that the pyrometer of the cases reads.

    Raises
    ------
    DataError, CaseError
        In one line; nothing is written then.
    """
    measurements = read_measurements(measured)
    runs = simulated_runs(results, pyrometer=pyrometer)
    comparison = compare(measurements, runs)
    directory = Path(directory)
    tables = {
        "comparison.csv": comparison.table,
        "statistics.csv": comparison.statistics,
        "measured.csv": measurements.points.drop(columns="row"),
    }
    read = "simulated temperatures are those that the pyrometer of the cases reads"
    said = (*measurements.notes, *comparison.notes, *([read] if pyrometer else ()))
    text = _text(comparison, directory)
    lines = [*said, *(f"warning: {line}" for line in measurements.unusual), text]
    write_text(directory / "comparison.log", "\n".join(lines) + "\n")
    for name, table in tables.items():
        write_text(directory / name, spreadsheet.csv_text(table))
    save(draw_comparison(comparison), directory / "comparison.png")
    if measurements.profiles:
        save(draw_profiles(measurements, runs), directory / "profiles.png")
    return Report(text=text, notes=said, unusual=measurements.unusual)


def _text(comparison: Comparison, directory: Path) -> str:
    lines = ["simulated minus measured:", _shown(comparison.statistics)]
    if comparison.unmatched:
        names = ", ".join(comparison.unmatched[:_MOST_NAMES])
        others = len(comparison.unmatched) - _MOST_NAMES
        lines.append(f"without a simulation: {names}" + (f" and {others} more" * (others > 0)))
    return "\n".join([*lines, f"tables and pictures in {directory}"])


def _shown(statistics: pd.DataFrame) -> str:
    def percent(share: float) -> str:
        return "-" if math.isnan(share) else f"{share:.0%}"

    shares = [name for name in statistics if str(name).startswith(("share", "relative"))]
    formats, plain = {str(name): percent for name in shares}, "{:.3g}".format
    return str(
        statistics.to_string(index=False, formatters=formats, float_format=plain, na_rep="-")
    )
