"""The paper's figures by number."""

from collections.abc import Callable
from pathlib import Path

from validation.measured import Measurements
from validation.paper import fig2, fig3, fig4, fig6, fig7, fig8, fig9, fig10, fig11, fig12

#: Number of the figure to the function that draws it into a folder and returns the picture's path.
#: Figures 1 and 5 of the paper are a sketch and photographs.
FIGURES: dict[int, Callable[[Path], Path]] = {
    2: fig2.make,
    3: fig3.make,
    4: fig4.make,
    6: fig6.make,
    7: fig7.make,
    8: fig8.make,
    9: fig9.make,
    10: fig10.make,
    11: fig11.make,
    12: fig12.make,
}

#: Figures that show measurements beside the simulation.
MEASURABLE: dict[int, Callable[[Path, Measurements], Path]] = {11: fig11.make, 12: fig12.make}


def make_figure(number: int, directory: str | Path, measured: Measurements | None = None) -> Path:
    """Draw a figure of the paper, with a CSV of what it shows beside it.

    Parameters
    ----------
    number : int
        One of `FIGURES`.
    directory : str or Path
        Folder of the picture; made if it does not exist.
    measured : Measurements, optional
        Drawn into those of `MEASURABLE`.

    Returns
    -------
    Path
        The PNG.
    """
    if number not in FIGURES:
        known = ", ".join(map(str, sorted(FIGURES)))
        raise ValueError(f"figure {number} is not among those that can be made: {known}")
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    if measured is not None and number in MEASURABLE:
        return MEASURABLE[number](folder, measured)
    return FIGURES[number](folder)
