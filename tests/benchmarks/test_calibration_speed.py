"""Time of the fits: 5,000 points and 20 starts are meant to stay within 2 s."""

import numpy as np
import pandas as pd
import pytest

from calibration import fit_friction, fit_hyperelastic
from calibration.rubber.stress_models import STRESS_MODELS
from calibration.synthetic import synthetic_friction
from contact import HuemerFriction
from materials import compound


@pytest.mark.parametrize("model", STRESS_MODELS)
def test_hyperelastic_fit_of_5000_points_with_20_starts(benchmark, model):
    stretch = np.linspace(1.01, 2.5, 5000)
    stress = compound("yeoh-bars-series-1").nominal_stress(stretch, "uniaxial")
    stress = stress + np.random.default_rng(0).normal(0.0, 0.01, 5000)
    table = pd.DataFrame(
        {"stretch": stretch, "nominal_stress_N_per_mm2": stress, "mode": "uniaxial"}
    )
    result = benchmark.pedantic(fit_hyperelastic, (table, model), {"starts": 20}, rounds=3)
    assert result.success


def test_friction_fit_of_huemers_law(benchmark):
    table = synthetic_friction(HuemerFriction())
    result = benchmark.pedantic(fit_friction, (table, "huemer"), rounds=3)
    assert result.success


@pytest.mark.parametrize("name", ["yeoh-bars-series-1-load", "van-der-waals-bars-series-1"])
def test_energy_derivatives_at_13000_points(benchmark, name):
    rng = np.random.default_rng(0)
    I1, J = rng.uniform(3.0, 5.0, 13_000), rng.uniform(0.9, 1.1, 13_000)
    assert np.all(np.isfinite(benchmark(compound(name).derivatives, I1, J).W))
