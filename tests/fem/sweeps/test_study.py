"""Study files: full product, stable names, errors in one line."""

from __future__ import annotations

import pytest

from fem.case.errors import CaseError
from fem.sweeps.study import read_study
from fem.sweeps.sweep import size_of_study
from validation.paper.introductory import introductory_case
from validation.studies import BASES, cases_of


def test_the_grid_is_the_full_product_in_the_order_of_the_file(write_study):
    path = write_study(
        'base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7.0, 50.0]\n'
        'friction.law = ["huemer", "exponential"]'
    )
    cases = read_study(path).cases()
    assert [case.overrides for case in cases] == [
        {"loading.velocity_mm_per_s": v, "friction.law": law}
        for v in (7.0, 50.0)
        for law in ("huemer", "exponential")
    ]
    assert [c.case.loading.velocity_mm_per_s for c in cases] == [7.0, 7.0, 50.0, 50.0]
    assert cases[0].name == "velocity_mm_per_s_7.0__law_huemer"
    assert len({case.name for case in cases}) == 4


def test_the_keys_of_a_section_change_together(write_study):
    path = write_study(
        'base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7.0, 50.0]\n'
        "block = [{height_mm = 7.0}, {height_mm = 9.0, blocks = 2}]"
    )
    cases = read_study(path).cases()
    assert [c.case.block.blocks for c in cases] == [1, 2, 1, 2]
    assert cases[1].overrides == {
        "loading.velocity_mm_per_s": 7.0,
        "block.height_mm": 9.0,
        "block.blocks": 2,
    }


def test_each_extra_case_is_combined_with_the_grid(write_study):
    path = write_study(
        'base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7.0, 50.0]\n'
        '[[case]]\n"block.height_mm" = 7.0\n[[case]]\n"block.height_mm" = 9.0\n'
        '"rubber.bulk_ratio" = 20.0'
    )
    cases = read_study(path).cases()
    assert [c.case.block.height_mm for c in cases] == [7.0, 7.0, 9.0, 9.0]
    assert cases[-1].case.rubber.bulk_ratio == 20.0


def test_a_study_without_grid_is_its_base_case(write_study):
    (case,) = read_study(write_study('base = "case.toml"')).cases()
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
        ('base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7, 7.0]', "twice"),
        ('base = "case.toml"\ncase = 3', r"tables \[\[case\]\]"),
        ('base = "case.toml"\n[grid]\nblock = [1, 2]', "block: found 1, expected"),
        ('base = "case.toml"\ngrid = 5', "grid: found 5, expected a table"),
        ('base = "case.toml"\nnames = "abc"', 'names: found "abc", expected a table'),
        ('base = "case.toml"\n[names]\n"friction.law" = "law"', "does not vary"),
        (
            'base = "case.toml"\n[names]\n"block.height_mm" = 5\n[[case]]\n"block.height_mm" = 7.0',
            "a short name",
        ),
        ("base = ", "study.toml"),
    ],
)
def test_a_wrong_study_is_refused_in_one_line(write_study, text, words):
    with pytest.raises(CaseError, match=words) as error:
        read_study(write_study(text)).cases()
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("name, count", [("compounds", 6), ("velocities", 6), ("pressures", 36)])
def test_studies_of_the_paper_resolve(name, count):
    cases = cases_of(name)
    assert len(cases) == count
    assert {case.case.loading.distance_mm for case in cases} == {120.0}


def test_a_base_may_be_a_name_that_the_caller_knows(write_study):
    path = write_study('base = "introductory"')
    (case,) = read_study(path, BASES).cases()
    assert case.case == introductory_case()
    with pytest.raises(CaseError, match="introductory"):
        read_study(path).cases()


def test_the_grid_may_be_that_of_another_base(write_study, tmp_path):
    path = write_study('base = "case.toml"\n[grid]\n"block.height_mm" = [7.0, 9.0]')
    text = (tmp_path / "case.toml").read_text()
    other = tmp_path / "other.toml"
    other.write_text(f"{text}\n[wear]\ncoefficient_mm3_per_J = 1e-3\n")
    own, found = read_study(path).cases(), read_study(path, base=other).cases()
    assert [case.name for case in found] == [case.name for case in own]
    assert [case.case.block.height_mm for case in found] == [7.0, 9.0]
    assert {case.case.wear.coefficient_mm3_per_J for case in found} == {1e-3}


def test_the_base_of_the_studies_is_the_introductory_example():
    from fem.case.case import Case

    assert introductory_case() == Case.from_toml("examples/introductory.toml")


def test_values_that_differ_only_in_replaced_characters_are_told_apart(write_study):
    mesh = "{cells_x = 12, cells_y = 5, smallest_x_mm = 0.8, smallest_y_mm = 0.6}"
    (write_study("").parent / "a b.toml").write_text("[rubber]\nbulk_ratio = 20.0\n")
    (write_study("").parent / "a;b.toml").write_text("[rubber]\nbulk_ratio = 30.0\n")
    path = write_study(
        'base = "case.toml"\n[grid]\n"rubber.parameters" = ["a b.toml", "a;b.toml"]\n'
        f'"block.mesh" = [{mesh}]'
    )
    cases = read_study(path).cases()
    assert [case.case.rubber.bulk_ratio for case in cases] == [20.0, 30.0]
    assert len({case.name for case in cases}) == 2


def test_files_of_a_study_are_looked_for_beside_it(write_study, tmp_path, monkeypatch):
    (tmp_path / "mine.toml").write_text("[rubber]\nbulk_ratio = 20.0\n")
    path = write_study('base = "case.toml"\n[grid]\n"rubber.parameters" = ["mine.toml"]')
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    (case,) = read_study(path).cases()
    assert case.case.rubber.bulk_ratio == 20.0


def test_no_name_of_a_case_is_hidden_an_option_or_a_formula(write_study):
    path = write_study(
        'base = "case.toml"\n[names]\n"block.height_mm" = "-=."\n[grid]\n'
        '"block.height_mm" = [7.0, 9.0]'
    )
    assert [case.name for case in read_study(path).cases()] == ["7.0", "9.0"]


def test_combinations_are_numbered_as_they_are_listed(write_study):
    path = write_study(
        'base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7.0, 50.0, 300.0]\n'
        '"friction.law" = ["huemer", "exponential"]\n[[case]]\n[[case]]\n"block.height_mm" = 7.0'
    )
    study = read_study(path)
    cases = study.cases()
    assert study.number == len(cases) == 12
    assert study.some_cases(100) == [case.case for case in cases]
    assert study.some_cases(3) == [cases[number].case for number in (0, 5, 11)]


def test_a_study_of_a_million_cases_is_counted_without_making_them(write_study):
    values = ", ".join(f"{value}.0" for value in range(1, 1001))
    path = write_study(
        f'base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [{values}]\n'
        f'"loading.distance_mm" = [{values}]'
    )
    study = read_study(path)
    assert study.number == 10**6
    assert size_of_study(study, 2).startswith("1000000 cases: about ")
