"""A spread of the robustness study on the coarse mesh: every case goes through to its end."""

import pytest

from fem import simulate
from validation.sweeps.study import STUDIES, read_study

COARSE = {"block.mesh": "coarse"}
#: (compound, pressure, law, mu): every compound and law once, all pressures twice.
SPREAD = [
    ("mooney-rivlin-dumbbells", 0.25, "coulomb", 1.2),
    ("yeoh-bars-series-1", 0.5, "coulomb", 0.9),
    ("yeoh-bars-series-2", 0.5, "coulomb", 0.6),
    ("yeoh-bars-series-1-load", 0.1, "coulomb", 0.3),
    ("van-der-waals-bars-series-1", 0.25, "huemer", None),
    ("van-der-waals-bars-series-2", 0.1, "exponential", None),
]


@pytest.fixture(scope="module")
def study():
    return read_study(STUDIES / "robustness.toml")


def test_the_study_is_the_full_product(study):
    assert len(study) == 6 * 3 * 6


@pytest.mark.parametrize(("compound", "pressure", "law", "mu"), SPREAD)
def test_the_block_slides_to_the_end(study, compound, pressure, law, mu):
    wanted = {
        "rubber.compound": compound,
        "loading.mean_pressure_N_per_mm2": pressure,
        "friction.law": law,
    } | ({} if mu is None else {"friction.mu": mu})
    chosen = [c for c in study if wanted.items() <= c.overrides.items()]
    assert len(chosen) == 1
    summary = simulate(chosen[0].case.with_overrides(COARSE)).summary
    assert summary["status"] == "ok", summary.get("reason")
    assert summary["energy_error"] < 0.01
    assert summary["heat_error"] < 0.01
    assert summary["largest_self_penetration"] < 0.01
