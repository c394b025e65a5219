"""Study files: full product, stable names, errors in one line."""

from __future__ import annotations

import pytest

from fem.case_errors import CaseError
from validation.paper.introductory import introductory_case
from validation.sweeps.study import STUDIES, read_study


def test_the_grid_is_the_full_product_in_the_order_of_the_file(write_study):
    path = write_study(
        'base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7.0, 50.0]\n'
        'friction.law = ["huemer", "exponential"]'
    )
    cases = read_study(path)
    assert [case.overrides for case in cases] == [
        {"loading.velocity_mm_per_s": v, "friction.law": law}
        for v in (7.0, 50.0)
        for law in ("huemer", "exponential")
    ]
    assert [c.case.loading.velocity_mm_per_s for c in cases] == [7.0, 7.0, 50.0, 50.0]
    assert cases[0].name == "velocity_mm_per_s_7.0__law_huemer"
    assert len({case.name for case in cases}) == 4


def test_each_extra_case_is_combined_with_the_grid(write_study):
    path = write_study(
        'base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7.0, 50.0]\n'
        '[[case]]\n"block.height_mm" = 7.0\n[[case]]\n"block.height_mm" = 9.0\n'
        '"rubber.bulk_ratio" = 20.0'
    )
    cases = read_study(path)
    assert [c.case.block.height_mm for c in cases] == [7.0, 7.0, 9.0, 9.0]
    assert cases[-1].case.rubber.bulk_ratio == 20.0


def test_a_study_without_grid_is_its_base_case(write_study):
    (case,) = read_study(write_study('base = "case.toml"'))
    assert case.name == "base"


@pytest.mark.parametrize(
    "text, words",
    [
        ("[grid]", "base: found nothing, expected the name of a case file"),
        ('base = "nowhere.toml"', "nowhere.toml"),
        ('base = "case.toml"\ngird = 1', "gird: found an unknown key"),
        ('base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = 7.0', "a list of at least"),
        ('base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = []', "a list of at least"),
        ('base = "case.toml"\n[grid]\n"loading.velocity" = [7.0]', "loading.velocity"),
        ('base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7.0, 0.0]', "zero"),
        ('base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7.0, 7.0]', "twice"),
        ('base = "case.toml"\ncase = 3', r"tables \[\[case\]\]"),
        ("base = ", "study.toml"),
    ],
)
def test_a_wrong_study_is_refused_in_one_line(write_study, text, words):
    with pytest.raises(CaseError, match=words) as error:
        read_study(write_study(text))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("name, count", [("compounds", 6), ("velocities", 6), ("pressures", 36)])
def test_studies_of_the_paper_resolve(name, count):
    cases = read_study(STUDIES / f"{name}.toml")
    assert len(cases) == count
    assert {case.case.loading.distance_mm for case in cases} == {120.0}


def test_the_base_of_the_studies_is_the_introductory_example():
    from fem.case import Case

    assert introductory_case() == Case.from_toml("examples/introductory.toml")
