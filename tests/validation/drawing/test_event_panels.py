"""Pictures of an event: nothing overlaps, axes have units, and the files are pictures."""

import pytest
from PIL import Image

from fem import simulate
from tests.fem.test_events import LIFT, PRESS, event, slide
from tests.validation.checks import assert_labelled, assert_nothing_overlaps
from validation.drawing.event_panels import draw_event, draw_pyrometer, draw_wear, write_animation


@pytest.fixture(scope="module")
def result():
    case = event(
        PRESS,
        slide(300.0, distance_mm=2.0),
        LIFT,
        loading={"repeat": 2},
        block={"rigid": True},
        output={"snapshots": 4},
        pyrometer={"gap_mm": 5.0, "spot_mm": 2.0},
        wear={"coefficient_mm3_per_J": 2e-3},
    )
    return simulate(case)


def test_pictures_of_an_event_are_readable(result):
    for figure in (draw_event(result, result.contacts), draw_pyrometer(result), draw_wear(result)):
        assert_nothing_overlaps(figure)
        assert_labelled(figure)


def test_the_animation_has_a_frame_per_snapshot(result, tmp_path):
    with Image.open(write_animation(result, tmp_path / "contact.gif")) as film:
        assert film.format == "GIF"
        assert film.n_frames == len(result.snapshots)


def test_the_pyrometer_is_drawn_beside_the_end_of_contact(result):
    (axes,) = draw_pyrometer(result).axes
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == ["end of contact", "spot over a corner", "pyrometer"]
    shown = dict(zip(labels, (line.get_ydata() for line in axes.lines), strict=True))
    assert (shown["end of contact"] == result.pyrometer["T_C"]).all()
    whole = (result.pyrometer["spot_covered"] == 1.0).to_numpy()
    assert (shown["pyrometer"][whole] == result.pyrometer["T_pyrometer_C"][whole]).all()
