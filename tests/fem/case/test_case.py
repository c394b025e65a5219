"""The case: defaults, resolution, round trips, references, overrides; faults are named."""

from __future__ import annotations

import datetime
import math
import tomllib
from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError

from fem.case.case import Case
from fem.case.errors import CaseError
from fem.case.reading import parse_override
from fem.case.template import case_template
from materials import ASPHALT, COMPOUNDS, RUBBER, ArrudaBoyce, NeoHooke, Ogden, VanDerWaals, Yeoh

LOADING = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300, "distance_mm": 120.0}
YEOH = {
    "model": "yeoh",
    "C10_N_per_mm2": 0.3,
    "C20_N_per_mm2": 0.01,
    "C30_N_per_mm2": -0.0001,
}


def case_with(**sections: object) -> Case:
    return Case.from_dict({"loading": LOADING, **sections})


# -- defaults and objects ------------------------------------------------------------------------


def test_only_the_loading_has_to_be_given():
    case = Case.from_dict({"loading": LOADING})
    assert (case.block.length_mm, case.block.height_mm, case.block.mesh) == (20.0, 8.0, "default")
    assert case.rubber.compound == "yeoh-bars-series-1-load"
    assert case.friction.law == "huemer"
    assert case.friction.wlf


def test_default_thermal_data_are_the_named_sets():
    case = case_with()
    assert case.rubber.thermal == RUBBER
    assert case.road.thermal == ASPHALT


def test_default_friction_is_the_paper_law_at_its_reference_temperature():
    case = case_with(friction={"wlf": False})
    mu = case.friction.law_object().coefficient(0.3, [26.5, 300.0], 55.0)
    assert mu == pytest.approx([0.960, 0.9056], abs=5e-4)


def test_warmer_rubber_acts_like_a_slower_one():
    case = case_with(friction={"law": "exponential"})
    cold, warm = case.friction.law_object().coefficient(0.3, 300.0, [20.0, 40.0])
    assert warm < cold


def test_wlf_can_be_switched_off():
    law = case_with(friction={"law": "exponential", "wlf": False}).friction.law_object()
    cold, warm = law.coefficient(0.3, 300.0, [20.0, 40.0])
    assert warm == cold


def test_floors_reach_the_friction_law():
    case = case_with(friction={"p_min_N_per_mm2": 0.05, "v_min_mm_per_s": 7.0})
    law = case.friction.plain_law()
    assert (law.p_min, law.v_min) == (0.05, 7.0)


@pytest.mark.parametrize("name", COMPOUNDS)
def test_every_compound_can_be_named(name):
    assert case_with(rubber={"compound": name}).rubber.model() is COMPOUNDS[name]


@pytest.mark.parametrize(
    ("table", "model"),
    [
        ({"model": "neo-hooke", "G_N_per_mm2": 0.6}, NeoHooke(G=0.6)),
        (YEOH, Yeoh(C10=0.3, C20=0.01, C30=-0.0001)),
        (
            {"model": "van-der-waals", "G_N_per_mm2": 0.6, "lambda_m": 5.0, "a": 0.7},
            VanDerWaals(G=0.6, lambda_m=5.0, a=0.7, beta=0.0),
        ),
        (
            {"model": "arruda-boyce", "C1_N_per_mm2": 0.6, "lambda_m": 3.0},
            ArrudaBoyce(C1=0.6, lambda_m=3.0),
        ),
        (
            {"model": "ogden", "mu_N_per_mm2": [0.5, 0.02], "alpha": [1.3, -3]},
            Ogden(mu=(0.5, 0.02), alpha=(1.3, -3.0)),
        ),
    ],
)
def test_model_with_constants(table, model):
    assert case_with(rubber=table).rubber.model() == model


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"alpha": [1.3]}, "found mu has 2 and alpha 1 entries, expected as many of each"),
        ({"alpha": [1.3, 0.0]}, "found alpha2 is 0, expected another number"),
        ({"alpha": 1.3}, "rubber.alpha: found 1.3, expected an array of numbers"),
        ({"alpha": None}, "rubber.alpha: found nothing, expected a number"),
        ({"mu_N_per_mm2": [0.5, "x"]}, "rubber.mu_N_per_mm2.1: found the text"),
        ({"mu_N_per_mm2": [0.5, -0.6]}, "found the sum of mu is -0.1, expected a number above"),
        ({"G_N_per_mm2": 1.0}, "G_N_per_mm2: found 1.0, expected only constants of model"),
    ],
)
def test_constants_of_ogden_that_make_no_energy_are_refused(change, message):
    table = {"model": "ogden", "mu_N_per_mm2": [0.5, 0.02], "alpha": [1.3, -3.0], **change}
    with pytest.raises(CaseError, match=message):
        case_with(rubber=table)


def test_bulk_modulus_is_the_ratio_times_the_shear_modulus():
    rubber = case_with(rubber={**YEOH, "bulk_ratio": 20}).rubber
    assert rubber.bulk_modulus == pytest.approx(20.0 * 2.0 * 0.3, rel=1e-14)


def test_heat_objects_carry_the_paper_numbers():
    heat = case_with().heat
    assert heat.conductance_object().conductance(0.3) == pytest.approx(1600.0)
    assert heat.partition_object()(0.3) == pytest.approx(0.3146 * 0.3**-0.6833)
    assert heat.partition_object()(0.1) == 1.0


def test_constant_partition_does_not_depend_on_pressure():
    heat = case_with(heat={"partition": {"law": "constant", "prefactor": 0.7}}).heat
    assert heat.partition_object()([0.05, 0.3, 2.0]) == pytest.approx([0.7] * 3)


def test_negative_velocity_is_allowed():
    assert case_with(loading={**LOADING, "velocity_mm_per_s": -50}).loading.velocity_mm_per_s == -50


def test_case_is_frozen():
    with pytest.raises(ValidationError, match="frozen"):
        case_with().loading.distance_mm = 3.0


# -- resolved text and hash ----------------------------------------------------------------------


@pytest.mark.parametrize(
    "sections",
    [
        {},
        {"rubber": YEOH, "friction": {"law": "coulomb", "mu": 0.9}},
        {"heat": {"partition": {"law": "constant", "prefactor": 0.7}}, "block": {"rigid": True}},
        {
            "block": {
                "mesh": {
                    "cells_x": 40,
                    "cells_y": 20,
                    "smallest_x_mm": 0.2,
                    "smallest_y_mm": 0.08,
                }
            }
        },
    ],
)
def test_resolved_text_reads_back_as_the_same_case(sections, tmp_path):
    case = case_with(**sections)
    path = tmp_path / "resolved.toml"
    path.write_text(case.to_toml(), encoding="utf-8")
    again = Case.from_toml(path)
    assert again == case
    assert again.hash() == case.hash()


def test_every_key_of_the_resolved_text_has_a_comment():
    for line in case_template().splitlines():
        if "=" in line and not line.startswith("#"):
            assert "  # " in line, line


def test_template_runs_as_it_is():
    assert Case.from_dict(tomllib.loads(case_template())) == case_with()


def test_introductory_example_is_the_template():
    example = Path(__file__).parents[3] / "examples" / "introductory.toml"
    assert Case.from_toml(example) == case_with()


def test_hash_sees_every_number_but_not_how_it_is_written():
    case = case_with()
    assert case.hash() == case_with(block={"length_mm": 20}).hash()
    assert case.hash() != case_with(block={"length_mm": math.nextafter(20.0, 21.0)}).hash()


# -- overrides -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("loading.velocity_mm_per_s=50", 50),
        ("loading.velocity_mm_per_s = -5e1", -50.0),
        ("block.rigid=true", True),
        ("rubber.compound=yeoh-bars-series-2", "yeoh-bars-series-2"),
        ('rubber.compound="yeoh-bars-series-2"', "yeoh-bars-series-2"),
        ("heat.partition={cap = 0.5}", {"cap": 0.5}),
        ("rubber.parameters=../fits/yeoh.toml", "../fits/yeoh.toml"),
        ("block.length_mm=nan", pytest.approx(math.nan, nan_ok=True)),
    ],
)
def test_override_values_are_read_as_toml_and_bare_words_as_text(text, value):
    assert parse_override(text)[1] == value


def test_override_changes_nothing_else():
    case = case_with().with_overrides({"loading.velocity_mm_per_s": 50.0})
    assert case == case_with(loading={**LOADING, "velocity_mm_per_s": 50.0})


def test_override_of_a_missing_key_completes_the_file(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text("[loading]\nmean_pressure_N_per_mm2 = 0.25\ndistance_mm = 1.0\n")
    assert Case.from_toml(path, {"loading.velocity_mm_per_s": 7}).loading.velocity_mm_per_s == 7.0


def test_naming_another_compound_drops_the_model_and_its_constants():
    case = case_with(rubber=YEOH).with_overrides({"rubber.compound": "yeoh-bars-series-2"})
    assert case == case_with(rubber={"compound": "yeoh-bars-series-2"})


def test_naming_a_model_drops_the_compound():
    case = case_with().with_overrides({f"rubber.{key}": value for key, value in YEOH.items()})
    assert case == case_with(rubber=YEOH)


def test_naming_another_law_drops_the_parameters_of_the_old_one():
    changes = {"friction.mu": 0.9, "friction.law": "coulomb"}
    assert case_with().with_overrides(changes) == case_with(friction={"law": "coulomb", "mu": 0.9})


def test_override_inside_a_named_mesh_asks_for_the_whole_table():
    with pytest.raises(CaseError, match=r"block\.mesh\.cells_y: found nothing"):
        case_with().with_overrides({"block.mesh.cells_x": 40})


# -- parameter files -----------------------------------------------------------------------------


def test_parameter_file_is_found_beside_the_case_and_the_case_wins(tmp_path, monkeypatch):
    folder = tmp_path / "cases"
    folder.mkdir()
    (tmp_path / "fit.toml").write_text(
        "[fit]\nmodel = 'yeoh'\n[rubber]\nmodel = 'yeoh'\nC10_N_per_mm2 = 0.3\n"
        "C20_N_per_mm2 = 0.01\nC30_N_per_mm2 = -0.0001\nbulk_ratio = 50.0\n"
    )
    path = folder / "case.toml"
    path.write_text(
        "[loading]\nmean_pressure_N_per_mm2 = 0.25\nvelocity_mm_per_s = 300.0\n"
        "distance_mm = 120.0\n[rubber]\nparameters = '../fit.toml'\nbulk_ratio = 20.0\n"
    )
    monkeypatch.chdir(folder.parent.parent)
    case = Case.from_toml(path)
    assert case == case_with(rubber={**YEOH, "bulk_ratio": 20.0})
    assert "parameters" not in case.to_toml()


def test_override_wins_over_the_parameter_file(tmp_path):
    (tmp_path / "fit.toml").write_text("[friction]\nlaw = 'coulomb'\nmu = 0.6\n")
    tables = {"loading": LOADING, "friction": {"parameters": "fit.toml"}}
    case = Case.from_dict(tables, folder=tmp_path, overrides={"friction.mu": 0.7})
    assert case.friction.constants["mu"] == 0.7


def test_parameter_file_named_by_an_override_replaces_the_compound(tmp_path, monkeypatch):
    (tmp_path / "fit.toml").write_text("[rubber]\nmodel = 'neo-hooke'\nG_N_per_mm2 = 0.6\n")
    monkeypatch.chdir(tmp_path)
    tables = {"loading": LOADING, "rubber": {"compound": "yeoh-bars-series-1"}}
    case = Case.from_dict(tables, folder="/", overrides={"rubber.parameters": "fit.toml"})
    assert case.rubber.model() == NeoHooke(G=0.6)


# -- faults --------------------------------------------------------------------------------------


KEYS = [
    (section, key)
    for section, table in case_with().to_dict().items()
    for key in (*table, "parameters", "lambda_m", "mu")
]
ODD_VALUES = [
    0,
    -1,
    1e-320,
    1e308,
    -math.inf,
    math.nan,
    10**400,
    True,
    "",
    "huemer",
    [],
    [1.0],
    {},
    {"law": "power"},
    {"law": {"law": 1}},
    datetime.time(12),
    None,
]


@pytest.mark.parametrize(("section", "key"), KEYS, ids=".".join)
def test_any_value_of_any_key_is_taken_or_refused_in_one_line(section, key):
    for value in ODD_VALUES:
        tables = {"loading": dict(LOADING)}
        tables.setdefault(section, {})[key] = value
        text = fault_of(tables)
        assert len(text.splitlines()) <= 1
        assert text == "" or key in text or section in text


def fault_of(tables: dict) -> str:
    """Text of the error, empty when the case is accepted; any other error passes through."""
    try:
        Case.from_dict(tables)
    except CaseError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("number", [np.float64(50.0), np.int64(50), np.float32(50.0)])
def test_numpy_numbers_are_numbers(number):
    case = case_with().with_overrides({"loading.velocity_mm_per_s": number})
    assert case == case_with(loading={**LOADING, "velocity_mm_per_s": 50.0})
    assert "velocity_mm_per_s = 50.0 " in case.to_toml()


def test_texts_in_errors_cannot_break_the_line():
    with pytest.raises(CaseError) as caught:
        case_with(rubber={"compound": "a\nb\r\x1b[31m" + "c" * 500})
    assert len(str(caught.value).splitlines()) == 1
    assert "\x1b" not in str(caught.value)
    assert len(caught.value.found) < 100


def test_unreadable_file_is_named(tmp_path, monkeypatch):
    def refuse(self):
        raise PermissionError(13, "Permission denied")

    path = tmp_path / "case.toml"
    path.write_text("")
    monkeypatch.setattr(Path, "read_bytes", refuse)
    with pytest.raises(
        CaseError, match=r"case\.toml: file: found unreadable \(Permission denied\)"
    ):
        Case.from_toml(path)


# -- numbers ---------------------------------------------------------------------------------------


def test_numbers_of_numpy_are_those_of_python():
    mesh = {"cells_x": 40, "cells_y": 20, "smallest_x_mm": 0.2, "smallest_y_mm": 0.1}
    loading = {key: np.float32(value) for key, value in LOADING.items()}
    case = case_with(
        loading=loading,
        block={"mesh": {**mesh, "cells_x": np.int64(40)}, "rigid": np.bool_(True)},
        solver={"friction_passes": np.uint8(3)},
    )
    plain = case_with(block={"mesh": mesh, "rigid": True}, solver={"friction_passes": 3})
    assert case == plain
    assert case.hash() == plain.hash()
    assert case.with_overrides({"output.snapshots": np.int32(4)}).output.snapshots == 4


def test_both_zeros_are_the_same_case():
    zero, minus = (case_with(friction={"b": 1.0, "c": value}) for value in (0.0, -0.0))
    assert zero.hash() == minus.hash()
    assert "-0.0" not in minus.to_toml()


def test_another_law_of_the_heat_partition_drops_the_exponent_of_the_old_one():
    power = case_with(heat={"partition": {"exponent": -0.5}})
    constant = power.with_overrides({"heat.partition.law": "constant"})
    assert constant.heat.partition.exponent == 0.0
    back = constant.with_overrides({"heat.partition.law": "power"})
    assert back.heat.partition.exponent == case_with().heat.partition.exponent


def test_usual_cases_say_nothing():
    assert case_with().warnings == ()


@pytest.mark.parametrize("name", COMPOUNDS)
def test_compounds_of_the_paper_are_usual(name):
    assert case_with(rubber={"compound": name}).warnings == ()


def test_unusual_numbers_are_named_by_their_key():
    case = case_with(
        heat={"ambient_C": 77}, rubber={"model": "neo-hooke", "G_N_per_mm2": 30.0},
        friction={"law": "exponential", "A": 4.0},
    )  # fmt: skip
    found = {key: finding.value for key, finding in case.unusual()}
    assert found["heat.ambient_C"] == 77.0
    assert found["rubber.G_N_per_mm2"] == 30.0
    assert found["friction.law"] == pytest.approx(4.0 * 0.25**-0.0645 * 300**0.0425)
    assert len(case.warnings) == 3


@pytest.mark.parametrize("pressure, refused", [(0.2, False), (1.0, True)])
def test_friction_may_be_negative_only_where_no_run_goes(pressure, refused):
    """alpha p^(n-1) + beta is negative above (-beta/alpha)^(1/(n-1)) = 32 N/mm^2."""
    law = {"alpha": 0.2, "n": 0.8, "beta": -0.1}
    loading = {**LOADING, "mean_pressure_N_per_mm2": pressure}
    if refused:
        with pytest.raises(CaseError, match=r"friction\.law: found huemer with the coefficient -"):
            case_with(friction=law, loading=loading)
    else:
        assert case_with(friction=law, loading=loading).friction.beta == -0.1
