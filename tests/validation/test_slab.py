"""Slabs against plane strain: the comparison by hand, and the study on a mesh of a few cells."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from tests.validation.sliding_cases import sliding_case
from validation import slab
from validation.analysis import with_block
from validation.calculix.deck_mesh import PLANE, half_slab
from validation.calculix.deck_run import CalculixError, calculix_program
from validation.slab import SHOWN, TABLE, Run, block, compared, kept_tables, main, row

TIMES = [0.5, 0.99, 1.01, 1.5, 3.0]


def made_up_run(sink=1.0, middle=1.0, force=1.0, strain=0.0) -> Run:
    """Loads rise to 5 N/mm, the platen to 0.4 mm, the force to 1.5 N/mm; factors on them."""
    pressed = np.minimum(TIMES, 1.0)
    slid = np.maximum(np.array(TIMES) - 1.0, 0.0) / 2.0
    return Run(
        history=pd.DataFrame(
            {
                "deck_time": TIMES,
                "friction_force_N_per_mm": 1.5 * force * slid,
                "platen_displacement_mm": 0.4 * sink * pressed,
                "contact_length_mm": 20.0,
                "middle_load_N_per_mm": 5.0 * middle * pressed,
                "middle_peak_N_per_mm2": 0.3 * middle,
                "side_peak_N_per_mm2": 0.15,
                "depth_strain": strain * pressed,
                "side_lowest_mm": -1e-4,
            }
        )
    )


def test_equal_runs_have_ratios_of_one():
    found = compared(sliding_case(), made_up_run(), made_up_run())
    others = {
        "depth_strain_share_pressed": 0.0,
        "depth_strain_share_slid": 0.0,
        "side_peak_over_middle": 0.5,
        "side_lowest_um": -0.1,
    }
    assert found == pytest.approx({**dict.fromkeys(found, 1.0), **others})


def test_ratios_are_those_of_the_slab_over_plane_strain():
    """8 mm high: a strain of 0.01 along z is a fifth of 0.4 mm over 8 mm."""
    found = compared(sliding_case(), made_up_run(1.2, 1.1, 0.9, 0.012), made_up_run())
    assert found["platen_pressed"] == found["platen_slid"] == pytest.approx(1.2)
    assert found["force_at_0.5_mm"] == found["force_at_2_mm"] == pytest.approx(0.9)
    assert found["middle_load_slid"] == pytest.approx(1.1)
    # The load of plane strain is carried at 1/1.1 of the slab's displacement.
    assert found["middle_platen_at_equal_load"] == pytest.approx(1.2 / 1.1, rel=1e-2)
    assert found["depth_strain_share_slid"] == pytest.approx(0.012 * 8.0 / 0.48)


def test_what_calculix_does_not_finish_is_a_row_with_its_reason(tmp_path, monkeypatch):
    def gives_up(*_, **__):
        raise CalculixError("ccx took more than 1 s")

    monkeypatch.setattr(slab, "run_calculix", gives_up)
    found = row(sliding_case(), 2.5, 3, tmp_path)
    assert found == {
        "depth_over_height": 2.5,
        "depth_mm": 20.0,
        "layers": 3,
        "status": "ccx took more than 1 s",
    }
    assert "took more than" in block(pd.DataFrame([found]))


def test_only_finished_results_of_the_same_deck_are_kept(tmp_path):
    deck, results = tmp_path / "deck.inp", tmp_path / "deck.dat"
    head = " total force (fx,fy,fz) for set ROAD and time {time:15.7E}\n\n"
    whole = head.format(time=3.0) + " -1.5 5.0 0.0\n"
    deck.write_text("*HEADING\n")
    assert not kept_tables(deck, "*HEADING\n", end=3.0)
    results.write_text(whole)
    (table,) = kept_tables(deck, "*HEADING\n", end=3.0)
    assert table.time == 3.0
    assert not kept_tables(deck, "*HEADING other\n", end=3.0)
    for unfinished in (head.format(time=2.9) + " -1.5 5.0 0.0\n", whole + " -1.5\n", ""):
        results.write_text(unfinished)
        assert not kept_tables(deck, "*HEADING\n", end=3.0)


def test_without_calculix_one_line_says_so(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("validation.calculix.deck_run.PROGRAM", "no-such-program")
    assert main(str(tmp_path)) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "calculix-ccx" in said
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(calculix_program() is None, reason="CalculiX (ccx) is missing")
@pytest.mark.slow
def test_a_slab_as_deep_as_it_is_high_is_softer_than_plane_strain(tmp_path):
    """The middle's pressures add up to the load: what is read off a deck is what it carries."""
    case = sliding_case(10, 4)
    free = slab.computed(case, half_slab(8.0, 4), tmp_path / "slab")
    plane = slab.computed(case, PLANE, tmp_path / "plane")
    assert plane.at(2.0, "middle_load_N_per_mm") == pytest.approx(5.0, rel=0.01)
    found = compared(case, free, plane)
    assert found["force_at_2_mm"] == pytest.approx(1.0, abs=0.01)
    assert found["platen_slid"] > 1.4
    assert found["middle_platen_at_equal_load"] > 1.3
    assert 0.1 < found["depth_strain_share_slid"] < 1.0
    assert found["side_lowest_um"] > -20.0


def test_the_page_says_what_the_committed_table_has():
    page = slab.PAGE.read_text(encoding="utf-8")
    assert with_block(page, "slab", block(pd.read_csv(TABLE))) == page


def test_the_committed_slabs_tend_to_plane_strain():
    table = pd.read_csv(TABLE)
    assert table["depth_over_height"].tolist() == list(slab.LAYERS)
    finished = table[table["status"] == "ok"]
    assert len(finished) >= 3
    for column in ("platen_pressed", "platen_slid", "middle_platen_at_equal_load"):
        assert (np.diff(finished[column]) < 0.0).all()
    assert set(SHOWN) <= set(table.columns)
