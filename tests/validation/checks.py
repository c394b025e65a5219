"""What every picture must satisfy."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox


def assert_nothing_overlaps(figure: Figure) -> None:
    """No two panels or colour bars, labels included, lie over each other or leave the picture."""
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    page = Bbox.from_bounds(0, 0, *figure.canvas.get_width_height()).padded(1.0)
    boxes = []
    for axes in figure.axes:
        # A twin axis lies over its partner by design.
        if any(np.allclose(axes.bbox.bounds, other.bbox.bounds) for other, _ in boxes):
            continue
        box = axes.get_tightbbox(renderer)
        assert page.containsx(box.x0), f"{axes.get_title(loc='left')!r} leaves the page"
        assert page.containsx(box.x1), f"{axes.get_title(loc='left')!r} leaves the page"
        assert page.containsy(box.y0)
        assert page.containsy(box.y1)
        boxes.append((axes, box.padded(-1.0)))
    for legend in figure.legends:
        box = legend.get_window_extent(renderer)
        assert page.contains(box.x0, box.y0), "the legend leaves the page"
        assert page.contains(box.x1, box.y1), "the legend leaves the page"
        assert not any(box.overlaps(other) for _, other in boxes), "the legend lies over a panel"
    for (one, a), (other, b) in combinations(boxes, 2):
        if other in one.child_axes or one in other.child_axes:
            continue
        assert not a.overlaps(b), f"{one} overlaps {other}"


def assert_labelled(figure: Figure) -> None:
    """Every visible axis that says what it shows also says its unit."""
    labels = [label for axes in figure.axes for label in (axes.get_xlabel(), axes.get_ylabel())]
    shown = [label for label in labels if label]
    assert shown
    assert [label for label in shown if "[" not in label] == []
