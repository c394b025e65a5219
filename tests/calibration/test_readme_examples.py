"""The calibrate commands of the documents, run on made-up measurements under the names they use."""

from __future__ import annotations

import re
import shlex
import tomllib
from pathlib import Path

import pandas as pd
import pytest

import treadfem
from calibration.commands import KINDS
from calibration.conductance.fit import synthetic_heating_record
from calibration.conductance.heating_rig import HeatingRig
from calibration.synthetic import synthetic_bar_cycles, synthetic_friction
from contact import HuemerFriction
from materials import WLF
from tests.calibration.memory import made_up_tests
from tests.calibration.partition.made_up_slides import RIGID
from tests.documents import PAGES, ROOT

CALIBRATION = ROOT / "calibration/README.md"


def examples(*pages):
    """Words behind `treadfem calibrate` of every indented example of some pages."""
    text = "\n".join(page.read_text(encoding="utf-8") for page in pages)
    lines = re.findall(r"^    (?:\.venv/bin/)?treadfem calibrate (.*)$", text, flags=re.MULTILINE)
    return [shlex.split(line) for line in lines]


def unique(examples):
    """Each once, in order."""
    return list(map(list, dict.fromkeys(map(tuple, examples))))


def shift_factors():
    T = [-10.0, 5.0, 20.0, 35.0, 50.0]
    return pd.DataFrame({"T_C": T, "log10_aT": WLF().log10_shift_factor(T, 20.0)})


def sweeps():
    from tests.calibration.made_up_sweeps import synthetic_sweeps

    return synthetic_sweeps(WLF(d1=17.0, d2_K=150.0), (0.0, 20.0, 40.0))


def slides():
    return pd.DataFrame(
        {
            "mean_pressure_N_per_mm2": [0.2, 0.3, 0.4],
            "v_mm_per_s": 300.0,
            "T_max_C": [23.5, 23.6, 23.4],
            "sigma_K": 0.5,
        }
    )


def friction():
    law = HuemerFriction(v_min=1e-9)
    return synthetic_friction(law, temperatures_C=(5.0, 35.0), wlf=WLF(), repeats=1)


def measurements(words):
    """Made-up measurements of the kind an example is about."""
    kind, name = words[:2]
    if kind == "wlf":
        return sweeps() if name == "sweeps.csv" else shift_factors()
    return {
        "hyperelastic": lambda: synthetic_bar_cycles(1),
        "viscoelastic": lambda: made_up_tests.stepwise_relaxation(0),
        "mullins": lambda: made_up_tests.softening_cycles(0),
        "friction": friction,
        "conductance": lambda: synthetic_heating_record(HeatingRig(ambient_C=20.0), every_s=60.0),
        "partition": slides,
    }[kind]()


@pytest.mark.parametrize("pages", [PAGES, (CALIBRATION,)], ids=["docs", "calibration"])
def test_every_kind_is_shown(pages):
    kinds = {words[0] for words in examples(*pages)}
    assert kinds == set(KINDS)


@pytest.mark.slow
@pytest.mark.parametrize("words", unique([*examples(*PAGES), *examples(CALIBRATION)]), ids=" ".join)
def test_example_makes_a_parameter_file(words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    measurements(words).to_csv(words[1], index=False)
    Path("rig.toml").write_text("[rig]\nambient_C = 20.0\n")
    for name in ("my_case.toml", "block.toml"):
        Path(name).write_text(RIGID)
    assert treadfem.main(["calibrate", *words, "--quiet"]) == 0
    folder = Path(words[words.index("-o") + 1])
    content = tomllib.loads((folder / "parameters.toml").read_text())
    assert set(content) & {"rubber", "friction", "heat"}
    assert content["fit"]["data_file"] == words[1]
