"""Pictures do not depend on the day or on the caller's settings."""

from __future__ import annotations

import matplotlib

from validation.drawing.style import MM_PER_INCH, RESOLUTION, new_figure, save, styled

COLUMN_WIDTH = 120.0


@styled
def picture(path):
    figure = new_figure(COLUMN_WIDTH, 60.0)
    axes = figure.subplots()
    axes.plot([0, 1], [0, 1])
    axes.set_xlabel("$x$ [mm]")
    return save(figure, path)


def test_equal_figures_give_equal_files_whatever_the_callers_settings(tmp_path):
    first = picture(tmp_path / "a.png").read_bytes()
    with matplotlib.rc_context({"font.size": 20.0, "axes.grid": True, "savefig.bbox": "tight"}):
        assert picture(tmp_path / "b.png").read_bytes() == first


def test_drawing_leaves_the_callers_settings_alone(tmp_path):
    before = dict(matplotlib.rcParams)
    picture(tmp_path / "a.png")
    assert dict(matplotlib.rcParams) == before


def test_the_picture_has_the_width_asked_for(tmp_path):
    import matplotlib.image

    pixels = matplotlib.image.imread(picture(tmp_path / "a.png")).shape[1]
    assert abs(pixels - COLUMN_WIDTH / MM_PER_INCH * RESOLUTION) <= 1
