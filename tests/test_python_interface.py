"""The Python names users' scripts and notebooks rely on, line by line as they are documented."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

EXAMPLE = Path(__file__).parents[1] / "examples" / "introductory.toml"


def test_hyperelastic_models_give_nominal_stress():
    from materials import MooneyRivlin, Yeoh

    model = Yeoh(C10=0.3794, C20=0.0232, C30=-0.0003)
    for mode in ("uniaxial", "equibiaxial", "planar"):
        stress = model.nominal_stress(np.array([0.8, 1.0, 1.5]), mode)
        assert stress.shape == (3,)
        assert stress[0] < 0.0 < stress[2]
        assert stress[1] == pytest.approx(0.0, abs=1e-12)
    assert MooneyRivlin(C10=0.5, C01=0.2).nominal_stress(1.5, "uniaxial") > 0.0


def test_van_der_waals_and_named_compounds():
    from materials import VanDerWaals, Yeoh, compound

    model = VanDerWaals(G=0.6, lambda_m=4.95, a=0.68, beta=0.0)
    assert model.nominal_stress(2.0, "planar") > 0.0
    assert isinstance(compound("yeoh-bars-series-2"), Yeoh)


def test_rubber_with_a_memory_gives_the_stress_of_a_history():
    from materials import WLF, NeoHooke, OgdenRoxburgh, Prony, Rubber

    rubber = Rubber(
        elastic=NeoHooke(G=0.7),
        viscous=Prony(g=[0.3], tau_s=[0.1], moduli="long-term", shift=WLF(d1=7.0, d2_K=120.0)),
        damage=OgdenRoxburgh(r=2.0, m=0.3, beta=0.1),
    )
    time, stretch = np.array([0.0, 0.1, 5.0, 5.1]), np.array([1.0, 1.5, 1.5, 1.2])
    for mode in ("uniaxial", "equibiaxial", "planar"):
        stress = rubber.nominal_stress(time, stretch, mode, T_C=30.0)
        assert stress[1] > stress[2] > stress[3]


def test_wlf_equivalent_velocity_falls_with_temperature():
    from materials import WLF

    shift = WLF(d1=43.1, d2_K=509.4)
    assert shift.equivalent_velocity(300.0, 20.0, 20.0) == pytest.approx(300.0)
    assert shift.equivalent_velocity(300.0, 30.0, 20.0) == pytest.approx(45.0, rel=0.1)


def test_friction_laws_broadcast_over_pressure_and_velocity():
    from contact import ExponentialFriction, HuemerFriction

    p, v = np.array([[0.2], [0.4]]), np.array([7.0, 50.0, 300.0])
    assert HuemerFriction().coefficient(p, v).shape == (2, 3)
    assert HuemerFriction().coefficient(0.3, 26.5) == pytest.approx(0.960, abs=5e-4)
    assert ExponentialFriction().coefficient(0.3, 300.0) == pytest.approx(0.973, abs=5e-4)


def test_conductance_and_partition():
    from contact import GapConductance, HeatPartition

    conductance = GapConductance(h_ref=1600.0, p_ref=0.3)
    assert conductance.conductance(0.3) == pytest.approx(1600.0)
    assert conductance.conductance(np.array([0.1, 0.3, 0.5])).shape == (3,)
    assert HeatPartition()(0.3) == pytest.approx(0.3146 * 0.3**-0.6833)
    assert HeatPartition()(0.1) == 1.0


def test_a_case_is_simulated_and_written(tmp_path):
    """The example's own file, made small by overrides."""
    from fem import Case, simulate

    case = Case.from_toml(EXAMPLE).with_overrides(
        {"block.mesh": "coarse", "loading.distance_mm": 0.2, "output.snapshots": 1}
    )
    result = simulate(case)
    assert isinstance(result.history, pd.DataFrame)
    assert isinstance(result.surface, pd.DataFrame)
    assert isinstance(result.summary, dict)
    assert result.summary["status"] == "ok"
    result.write(tmp_path / "run")
    written = {path.name for path in (tmp_path / "run").iterdir()}
    expected = {"case.toml", "run.log", "history.csv", "surface.csv", "summary.json", "summary.csv"}
    assert expected <= written
    assert {"block.pvd", "road.pvd"} <= written
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["status"] == "ok"


def check_fit(fit, names, tmp_path):
    """The attributes every calibration's result has."""
    assert set(names) <= set(fit.values)
    assert set(names) <= set(fit.stderr)
    assert np.asarray(fit.covariance).shape[0] == np.asarray(fit.covariance).shape[1]
    assert fit.rmse >= 0.0
    assert fit.r2 > 0.99
    assert fit.n_data > 0
    assert isinstance(fit.message, str)
    fit.to_toml(tmp_path / "parameters.toml")
    assert (tmp_path / "parameters.toml").stat().st_size > 0


def test_a_hyperelastic_model_is_fitted_to_a_table(tmp_path):
    from calibration import fit_hyperelastic
    from materials import Yeoh

    true = Yeoh(C10=0.3794, C20=0.0232, C30=0.001)
    tables = []
    for mode in ("uniaxial", "planar"):
        stretch = np.linspace(1.05, 2.0, 20)
        stress = true.nominal_stress(stretch, mode)
        tables.append(
            pd.DataFrame({"stretch": stretch, "nominal_stress_N_per_mm2": stress, "mode": mode})
        )
    fit = fit_hyperelastic(pd.concat(tables, ignore_index=True), model="yeoh")
    assert fit.values["C10"] == pytest.approx(0.3794, rel=1e-4)
    check_fit(fit, ("C10", "C20", "C30"), tmp_path)


def test_a_friction_law_is_fitted_to_a_table(tmp_path):
    from calibration import fit_friction
    from contact import HuemerFriction

    p, v = np.meshgrid([0.1, 0.2, 0.3, 0.4], np.geomspace(2.0, 500.0, 9))
    mu = HuemerFriction().coefficient(p, v)
    table = pd.DataFrame({"p_N_per_mm2": p.ravel(), "v_mm_per_s": v.ravel(), "mu": mu.ravel()})
    fit = fit_friction(table, law="huemer")
    check_fit(fit, ("n",), tmp_path)
    assert fit.rmse < 1e-3
