"""A friction law that is registered after the program was loaded: case, messages, run, fit."""

from dataclasses import dataclass

import numpy as np
import pandas as pd
import pytest

from calibration import fit_friction
from contact import FRICTION_LAWS, FrictionLaw, friction_law, parameter
from contact.registry import _LAWS
from fem import Case, simulate
from fem.case import CaseError, case_template

LOADING = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 1.0}


@pytest.fixture(scope="module", autouse=True)
def law():
    """A law of the speed, of both temperatures and of the slip."""
    Case.from_dict({"loading": LOADING})  # cases have been read before

    @friction_law("sliding-in", label="law of the tests")
    @dataclass(frozen=True, kw_only=True)
    class SlidingIn(FrictionLaw):
        mu_1: float = parameter("coefficient at 1 mm/s [-]", low=0.0, high=3.0)
        k: float = parameter("growth with the logarithm of the speed [-]", 0.05, low=-1.0, high=1.0)
        way_mm: float = parameter("slip over which it comes [mm]", 0.5, low=1e-3, high=1e3)

        def _mu(self, at):
            come = 1.0 - np.exp(-np.nan_to_num(at.slip, nan=np.inf) / self.way_mm)
            return (self.mu_1 + self.k * np.log(at.v)) * come + 0.0 * at.p

    yield SlidingIn
    del _LAWS["sliding-in"]
    Case.from_dict({"loading": LOADING})


def case_of(**friction):
    return Case.from_dict(
        {
            "loading": LOADING,
            "block": {"mesh": {"cells_x": 12, "cells_y": 5, "smallest_x_mm": 1.0,
                               "smallest_y_mm": 1.0}},
            "friction": {"law": "sliding-in", "wlf": False, "memory_mm": 0.0, **friction},
        }
    )  # fmt: skip


def test_a_case_takes_its_parameters_and_is_written_with_them():
    case = case_of(mu_1=0.4)
    assert case.friction.constants == {"mu_1": 0.4, "k": 0.05, "way_mm": 0.5}
    text = case.to_toml()
    assert "mu_1 = 0.4" in text
    assert "# coefficient at 1 mm/s [-]" in text
    assert case.with_overrides({"friction.k": 0.1}).friction.plain_law().k == 0.1
    assert '"sliding-in", law of the tests' in case_template()


@pytest.mark.parametrize(
    ("friction", "message"),
    [
        ({}, 'friction.mu_1: found nothing, expected a number: law = "sliding-in" needs mu_1'),
        ({"mu_1": -0.1}, "friction.mu_1: found -0.1, expected a number of at least 0"),
        ({"mu_1": 0.4, "kk": 1.0}, "friction.kk: found an unknown key, expected k"),
        ({"mu_1": 0.4, "alpha": 0.1}, "expected only parameters of law"),
        ({"law": "sliding"}, 'found "sliding", expected "sliding-in"'),
    ],
)
def test_wrong_parameters_are_refused_as_those_of_other_laws_are(friction, message):
    with pytest.raises(CaseError, match=message):
        case_of(**friction)


def test_a_rigid_block_slides_in_by_the_formula():
    case = case_of(mu_1=0.1, way_mm=3.0).with_overrides(
        {"block.rigid": True, "loading.distance_mm": 9.0}
    )
    history = simulate(case).history
    # The first step begins without friction, which no pass corrects: there is nothing to compare.
    s = history["sliding_distance_mm"].to_numpy()[1:]
    expected = (0.1 + 0.05 * np.log(300.0)) * (1.0 - np.exp(-s / 3.0))
    np.testing.assert_allclose(history["friction_coefficient"][1:], expected, rtol=1e-12)


def test_the_nodes_of_a_block_know_their_slip_since_touch_down():
    """It is the way of the platen and some tenths of a millimetre, by which pressing spreads it."""
    slow, fast = (simulate(case_of(mu_1=0.1, way_mm=way)).history for way in (3.0, 1e-3))
    ratio = slow["friction_coefficient"].iloc[-1] / fast["friction_coefficient"].iloc[-1]
    slip = -3.0 * np.log(1.0 - ratio)
    assert 1.0 < slip < 1.3


def test_it_is_fitted_without_more(law):
    p, v = (a.ravel() for a in np.meshgrid([0.1, 0.3, 0.9], np.geomspace(1.0, 500.0, 12)))
    mu = law(mu_1=0.31, k=0.07).coefficient(p, v)
    table = pd.DataFrame({"p_N_per_mm2": p, "v_mm_per_s": v, "mu": mu})
    result = fit_friction(table, "sliding-in", fixed={"way_mm": 0.5})
    assert result.values["mu_1"] == pytest.approx(0.31, rel=1e-6)
    assert result.values["k"] == pytest.approx(0.07, rel=1e-6)


def test_two_laws_cannot_have_one_name():
    with pytest.raises(ValueError, match="'huemer' is registered already"):
        friction_law("huemer", label="")(type("Other", (FrictionLaw,), {}))
    assert FRICTION_LAWS["huemer"].kind.__name__ == "HuemerFriction"
