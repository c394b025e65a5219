"""Tables as laboratories publish them, through the command line to a parameter file."""

import tomllib

import numpy as np
import pandas as pd
import pytest

import treadfem
from fem.case.case import Case
from materials import WLF, MooneyRivlin

RUBBER = MooneyRivlin(C10=0.31, C01=0.07)
POLYISOPRENE = WLF(d1=5.9, d2_K=120.0)


def calibrate(kind, text, folder, *options):
    data = folder / "data.csv"
    data.write_text(text)
    words = ["calibrate", kind, str(data), *options, "-o", str(folder / "out"), "--quiet"]
    assert treadfem.main([*words, "--no-compare"] if kind != "wlf" else words) == 0
    return tomllib.loads((folder / "out" / "parameters.toml").read_text())


def test_engineering_strain_with_semicolons_and_metadata_lines(tmp_path):
    strain = np.array([0.0, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0])
    stress = RUBBER.nominal_stress(1.0 + strain) + 0.01 * np.sin(40.0 * strain)
    rows = "\n".join(f"{a:.6f};{b:.9f};uniaxial" for a, b in zip(strain, stress, strict=True))
    head = "# specimen: bar 4\n# rate: 0.01 1/s\nstrain;nominal_stress_N_per_mm2;mode\n"
    found = calibrate("hyperelastic", head + rows + "\n", tmp_path, "--model", "mooney-rivlin")
    lam = 1.0 + strain.round(6)
    columns = np.stack([2 * (lam - lam**-2), 2 * (1 - lam**-3)], axis=1)
    expected = np.linalg.lstsq(columns, stress.round(9), rcond=None)[0]
    values = [found["rubber"]["C10_N_per_mm2"], found["rubber"]["C01_N_per_mm2"]]
    assert values == pytest.approx(expected, rel=1e-6)
    assert found["rubber"]["window"] == {"largest_stretch": 2.0}
    assert found["fit"]["rows_used"] == len(strain)
    assert "the stretch is 1 + strain" in found["fit"]["notes"]


def test_a_loop_with_preload_is_that_of_the_unloaded_rubber(tmp_path):
    lam = np.concatenate([np.linspace(1.0, 1.9, 30), np.linspace(1.9, 1.0, 30)])
    table = pd.DataFrame({"stretch": lam, "mode": "uniaxial", "cycle": 1})
    table["nominal_stress_N_per_mm2"] = RUBBER.nominal_stress(lam) + 0.08
    words = ["--model", "mooney-rivlin", "--branch", "load", "--zero", "first"]
    found = calibrate("hyperelastic", table.to_csv(index=False), tmp_path, *words)
    assert found["rubber"]["C10_N_per_mm2"] == pytest.approx(0.31, rel=1e-6)
    assert found["rubber"]["C01_N_per_mm2"] == pytest.approx(0.07, rel=1e-6)
    assert found["fit"]["zero"] == "first"
    assert "0.08 N/mm^2, is subtracted" in found["fit"]["notes"][0]
    assert found["fit"]["rows_left_out"][0].endswith("not on the load path")


def test_oscillatory_sweeps_with_moduli_over_angular_frequency(tmp_path):
    # a lightly cross-linked melt: network and two Maxwell elements, G ~ T, shifted by WLF
    rows = []
    for T in (-10.0, 0.0, 15.0, 30.0, 50.0):
        omega = np.logspace(-1, 2, 13)
        x = 1j * omega * 10.0 ** POLYISOPRENE.log10_shift_factor(T, 15.0)
        G = 0.05 + 0.3 * x / (1.0 + x) + 0.15 * (x / 30.0) / (1.0 + x / 30.0)
        G *= (T + 273.15) / 288.15
        columns = {"omega_rad_per_s": omega, "modulus_N_per_mm2": G.real}
        rows.append(pd.DataFrame({"T_C": T, **columns, "loss_modulus_N_per_mm2": G.imag}))
    text = pd.concat(rows).to_csv(index=False)
    found = calibrate("wlf", text, tmp_path, "--T-ref", "15")
    assert found["friction"]["d1"] == pytest.approx(5.9, rel=0.02)
    assert found["friction"]["d2_K"] == pytest.approx(120.0, rel=0.02)
    assert found["friction"]["wlf_T_ref_C"] == 15.0
    assert found["friction"]["window"] == {"T_C": [-10.0, 50.0]}
    assert found["fit"]["vertical_shift"].startswith("b_T = T rho/(T_0 rho_0)")
    assert found["fit"]["rows_used"] == 65
    loading = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 5.0}
    friction = {"parameters": "out/parameters.toml"}
    case = Case.from_dict({"friction": friction, "loading": loading}, folder=tmp_path)
    expected = POLYISOPRENE.rebased(15.0, 20.0)
    assert case.friction.shift().d2_K == pytest.approx(expected.d2_K, rel=0.02)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_shift_factors_of_either_sign(sign, tmp_path):
    T = np.linspace(-10.0, 60.0, 8)
    table = pd.DataFrame({"T_C": T})
    table["log10_aT"] = sign * POLYISOPRENE.log10_shift_factor(T, 20.0)
    words = [] if sign > 0.0 else ["--other-sign"]
    found = calibrate("wlf", table.to_csv(index=False), tmp_path, "--T-ref", "20", *words)
    assert found["friction"]["d1"] == pytest.approx(5.9, rel=1e-6)
    assert found["friction"]["d2_K"] == pytest.approx(120.0, rel=1e-6)
