"""How results are drawn: style, fields on the block, curves of a run."""

from pathlib import Path
from typing import TYPE_CHECKING

from fem.files import face

_LAST = Path("figures") / "final_state.png"


def draw_missing(directory: Path) -> None:
    """Draw the figures of a run's folder unless they are there."""
    if not (directory / _LAST).exists():
        # matplotlib takes a second to load.
        from validation.drawing.run_figures import write_run_figures

        write_run_figures(directory)


if TYPE_CHECKING:
    from validation.drawing.block_drawing import (
        Window,
        cell_areas,
        draw_mesh,
        draw_outline,
        draw_road,
        draw_smooth,
        mark_window,
        set_window,
    )
    from validation.drawing.compound_names import COMPOUND_LOOKS
    from validation.drawing.field_panels import (
        BlockState,
        colour_bar,
        draw_panel,
        draw_stress,
        stress_panel,
        stress_scale,
        vertical_stress,
    )
    from validation.drawing.history_panels import draw_friction, draw_temperature
    from validation.drawing.run_figures import write_run_figures
    from validation.drawing.state_panels import WIDTHS, draw_fields, last_state, reached
    from validation.drawing.style import (
        BLACK,
        BLUE,
        CURVES,
        DASHES,
        GREY,
        MARKERS,
        PAGE_WIDTH,
        RUBBER_GREY,
        STRESS_MAP,
        VERMILLION,
        new_figure,
        save,
        styled,
    )
else:
    __getattr__ = face(__name__, __file__)
