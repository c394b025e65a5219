"""How results are drawn: style, fields on the block, curves of a run."""

from pathlib import Path

#: The picture of a run that is drawn last.
_LAST = Path("figures") / "final_state.png"


def draw_missing(directory: Path) -> None:
    """Draw the figures of a run's folder unless they are there."""
    if not (directory / _LAST).exists():
        # matplotlib takes a second to load.
        from validation.drawing.run_figures import write_run_figures

        write_run_figures(directory)
