"""The robustness study: its committed tables, and a spread of it repeated on the coarse mesh."""

import pandas as pd
import pytest

from fem import simulate
from validation.convergence.robustness import (
    BLOCKS,
    FOUND,
    OUTLINES,
    TABLE,
    TABLES,
    VARIED,
    VISCOELASTIC,
    robustness_table,
)
from validation.studies import cases_of

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
    return cases_of("robustness")


def test_the_study_is_the_full_product(study):
    assert len(study) == 6 * 3 * 6


def values(compound, pressure, law, mu):
    return {
        "rubber.compound": compound,
        "loading.mean_pressure_N_per_mm2": pressure,
        "friction.law": law,
    } | ({} if mu is None else {"friction.mu": mu})


def chosen(study, *row):
    (case,) = (c for c in study if values(*row).items() <= c.overrides.items())
    return case


@pytest.mark.parametrize(("compound", "pressure", "law", "mu"), SPREAD)
def test_the_block_slides_to_the_end(study, compound, pressure, law, mu):
    case = chosen(study, compound, pressure, law, mu).case
    summary = simulate(case.with_overrides(COARSE)).summary
    assert summary["status"] == "ok", summary.get("reason")
    assert summary["energy_error"] < 0.01
    assert summary["heat_error"] < 0.01
    assert summary["largest_self_penetration"] < 0.01


# -- the committed table ---------------------------------------------------------------------------


@pytest.fixture(scope="module")
def table():
    return pd.read_csv(TABLE)


def test_the_table_has_every_case_of_the_study(study, table):
    asked = [[case.overrides.get(key) for key in VARIED] for case in study]
    found = table[list(VARIED.values())].astype(object)
    assert found.where(found.notna(), None).to_numpy().tolist() == asked


@pytest.mark.slow
@pytest.mark.parametrize(("compound", "pressure", "law", "mu"), SPREAD[::2])
def test_rows_of_the_table_are_those_of_the_program(study, table, compound, pressure, law, mu):
    """The committed table is as old as the last `make robustness`: what it shows still holds.

    Above a coefficient of 1 the edge folds over by snaps, and the last digits of another processor
    choose another branch: 41.57 instead of 41.82 deg C in 876 instead of 820 iterations.
    """
    case = chosen(study, compound, pressure, law, mu).case
    asked = {"reason": None, "friction.mu": mu, **values(compound, pressure, law, mu)}
    again = robustness_table(pd.DataFrame([{**asked, **simulate(case).summary}])).iloc[0]
    known = pd.Series(values(compound, pressure, law, mu)).rename(VARIED)
    (row,) = table[(table[known.index] == known).all(axis=1)].to_dict("records")
    assert again["status"] == row["status"] == "ok"
    scatter = 0.5 if row["mu"] > 1.0 else 0.05
    assert again["T_max_C"] == pytest.approx(row["T_max_C"], abs=scatter)
    assert again["friction_coefficient"] == pytest.approx(row["friction_coefficient"], rel=2e-3)


def test_the_table_is_the_summary_of_a_sweep_in_four_digits():
    summary = pd.DataFrame([
        {**dict.fromkeys(VARIED, 0.123456), **dict.fromkeys(FOUND, 1.0 / 3.0), "status": "ok"}
    ])  # fmt: skip
    (row,) = robustness_table(summary.assign(elements=2880)).to_dict("records")
    assert row["status"] == "ok"
    assert row["min_J"] == 0.3333
    assert row["mu"] == 0.1235
    assert "elements" not in row


# -- blocks as they are ----------------------------------------------------------------------------


def test_the_study_of_blocks_has_every_shape_with_every_law_and_pressure():
    cases = cases_of("block_robustness")
    assert len(cases) == 48
    shapes = {
        (c.case.block.blocks, c.case.block.chamfer_leading_mm, len(c.case.block.sipes))
        for c in cases
    }
    assert shapes == {(1, 0.0, 0), (1, 1.0, 0), (1, 0.0, 1), (1, 0.0, 2), (1, 0.0, 3), (2, 0.0, 0)}
    assert {(c.case.friction.law, c.case.friction.mu) for c in cases} == {
        ("huemer", None),
        ("coulomb", 0.6),
        ("coulomb", 0.9),
    }
    assert len({c.case.rubber.compound for c in cases}) == 3
    assert {c.case.loading.mean_pressure_N_per_mm2 for c in cases} == {0.25, 0.4}
    assert {c.case.block.mesh for c in cases} == {"default"}


def test_sipes_are_counted_in_the_table_of_blocks():
    varied = dict.fromkeys([*OUTLINES, *VARIED, "advice"], 1.0)
    sipes = [[], [{"position_mm": 5.0}], [{"position_mm": 5.0}, {"position_mm": 9.0}]]
    summary = pd.DataFrame(
        [{**varied, **dict.fromkeys(FOUND, 1.0), "block.sipes": str(row)} for row in sipes]
    )
    assert robustness_table(summary)["sipes"].tolist() == [0, 1, 2]


@pytest.mark.parametrize("variant, cases", [(VISCOELASTIC, 108), (BLOCKS, 48)])
def test_tables_of_the_variants_have_every_case_and_balances_that_close(variant, cases):
    table = pd.read_csv(TABLES[variant])
    assert len(table) == cases
    assert (table["status"] == "ok").sum() >= cases - 2
    ok = table[table["status"] == "ok"]
    # One, at a coefficient of 1.2 and 0.5 N/mm^2, is warned of: 1.2 %.
    assert (ok["energy_error"] > 0.01).sum() <= 1
    assert ok["heat_error"].max() < 1e-9
    assert ok["largest_self_penetration"].max() <= 0.01


def test_rubber_that_damps_its_snaps_needs_nothing_artificial():
    table = pd.read_csv(TABLES[VISCOELASTIC])
    assert (table["regularisation_share_with_onset"] == 0.0).all()


def test_blocks_that_do_not_go_through_come_with_reason_and_advice():
    table = pd.read_csv(TABLES[BLOCKS])
    failed = table[table["status"] != "ok"]
    assert failed[["reason", "advice"]].notna().all(axis=None)
