"""Study files: full product, stable names, errors in one line; finished runs are not repeated."""

from __future__ import annotations

import pytest

from fem.case_errors import CaseError
from tests.made_up_result import made_up_result
from validation.paper.introductory import introductory_case
from validation.sweeps import study, sweep_case
from validation.sweeps.study import STUDIES, holds, read_study, study_runs, summary_table

BASE = """
[loading]
mean_pressure_N_per_mm2 = 0.25
velocity_mm_per_s = 300.0
distance_mm = 120.0
"""


@pytest.fixture
def write_study(tmp_path):
    (tmp_path / "case.toml").write_text(BASE)

    def write(text: str):
        path = tmp_path / "study.toml"
        path.write_text(text)
        return path

    return write


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


@pytest.fixture
def simulated(monkeypatch):
    """Velocities of the cases that were simulated, in this process; results are made up."""
    velocities = []

    def fake(case, checkpoint=None, resume=False):
        velocities.append(case.loading.velocity_mm_per_s)
        return made_up_result(velocity_mm_per_s=case.loading.velocity_mm_per_s)

    monkeypatch.setattr(sweep_case, "simulate", fake)
    monkeypatch.setattr(study, "number_of_workers", lambda *_: 1)
    return velocities


TWO = 'base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7.0, 50.0]'


def test_finished_runs_are_read_and_changed_ones_simulated_again(write_study, tmp_path, simulated):
    path = write_study(TWO)
    for _ in range(2):
        runs = study_runs(path, tmp_path / "out")
    assert simulated == [7.0, 50.0]
    assert [run["loading.velocity_mm_per_s"] for run in runs] == [7.0, 50.0]
    table = summary_table(runs)
    assert list(table.columns[:2]) == ["loading.velocity_mm_per_s", "status"]
    case_file = tmp_path / "out" / "runs" / "velocity_mm_per_s_50.0" / "case.toml"
    case_file.write_text(case_file.read_text().replace("height_mm = 8.0", "height_mm = 9.0"))
    (case_file.parent / sweep_case.MARKER).unlink()
    study_runs(path, tmp_path / "out")
    assert simulated == [7.0, 50.0, 50.0]


def test_runs_of_another_program_are_simulated_again(write_study, tmp_path, simulated, monkeypatch):
    path = write_study(TWO)
    study_runs(path, tmp_path / "out")
    for module in (study, sweep_case):
        monkeypatch.setattr(module, "program_version", lambda: "0.0.9+new")
    study_runs(path, tmp_path / "out")
    assert simulated == [7.0, 50.0] * 2


def test_run_that_raises_an_error_is_said_and_the_finished_ones_are_kept(
    write_study, tmp_path, simulated, monkeypatch
):
    def fails_at_50(case, **options):
        if case.loading.velocity_mm_per_s == 50.0:
            raise ValueError("no such thing")
        return made_up_result(velocity_mm_per_s=case.loading.velocity_mm_per_s)

    path = write_study(TWO)
    monkeypatch.setattr(sweep_case, "simulate", fails_at_50)
    with pytest.raises(study.StudyError, match=r"velocity_mm_per_s_50\.0: .*no such thing"):
        study_runs(path, tmp_path / "out")
    first, second = read_study(path)
    assert holds(tmp_path / "out" / "runs" / first.name, first.case)
    assert not holds(tmp_path / "out" / "runs" / second.name, second.case)


def test_an_interrupted_run_is_not_taken_for_a_finished_one(tmp_path):
    result = made_up_result()
    result.summary["status"] = "interrupted"
    result.write(tmp_path)
    assert not holds(tmp_path, result.case)


def test_a_run_of_a_version_with_other_keys_is_not_taken_for_this_case(tmp_path):
    result = made_up_result()
    result.write(tmp_path)
    assert holds(tmp_path, result.case)
    path = tmp_path / "case.toml"
    path.write_text(path.read_text().replace("height_mm", "tallness_mm"))
    assert not holds(tmp_path, result.case)
    path.unlink()
    assert not holds(tmp_path, result.case)


@pytest.mark.parametrize("name, count", [("compounds", 6), ("velocities", 6), ("pressures", 36)])
def test_studies_of_the_paper_resolve(name, count):
    cases = read_study(STUDIES / f"{name}.toml")
    assert len(cases) == count
    assert {case.case.loading.distance_mm for case in cases} == {120.0}


def test_the_base_of_the_studies_is_the_introductory_example():
    from fem.case import Case

    assert introductory_case() == Case.from_toml("examples/introductory.toml")
