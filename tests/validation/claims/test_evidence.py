"""Evidence gathers the runs of the studies and hands out only those that reached their end."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest

from fem import simulate
from fem.case.case import Case
from tests.made_up_result import made_up_result
from tests.validation.claims.made_up_evidence import with_summary
from tests.validation.made_up_run import made_up_run
from validation.claims.claim import DIFFERS, UNCHECKED
from validation.claims.evidence import LAWS, Evidence, Point, UnfinishedError, finished
from validation.claims.ledger import CLAIMS, judged
from validation.claims.section_5_2 import HIGH, LOW, rigid_block
from validation.claims.statements import CHANGES, case_keys
from validation.paper.table4 import PAPER_N_PER_MM
from validation.studies import BASES, cases_of


@pytest.fixture(scope="module")
def evidence(tmp_path_factory) -> Iterator[Evidence]:
    """Evidence whose studies are read from their files and answered with made-up runs."""

    result = made_up_result()

    def runs(study, directory):
        made_up = made_up_run()
        return [replace(made_up, study_case=case, result=result) for case in cases_of(study)]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("validation.claims.evidence.runs_of", runs)
        yield Evidence(tmp_path_factory.mktemp("figures"))


def test_runs_are_found_by_what_tells_them_apart(evidence):
    assert set(evidence.compounds) == set(PAPER_N_PER_MM)
    assert list(evidence.velocities) == [7.0, 50.0, 300.0]
    assert all(set(laws) == set(LAWS) for laws in evidence.velocities.values())
    assert len(evidence.pressures) == 18
    assert Point("yeoh-bars-series-1-load", 0.25, 50.0) in evidence.pressures


@pytest.mark.parametrize("change", CHANGES)
def test_every_change_that_is_tried_is_in_the_study(evidence, change):
    evidence.changed(case_keys(change))


def test_the_ends_of_table_4_are_in_the_study_with_every_change(evidence):
    order = next(c for c in CLAIMS if c.key == "order_of_forces")
    assert "nan" not in judged(order, evidence).experiment


def test_every_case_of_the_study_is_used():
    cases = cases_of("claims")
    tried = [
        *map(case_keys, CHANGES),
        *(rigid_block(law, p) for law in LAWS for p in (LOW, HIGH)),
    ]
    low = min(PAPER_N_PER_MM, key=PAPER_N_PER_MM.__getitem__)
    of_low = [{"rubber.compound": low, **keys} for keys in tried]
    assert [case.name for case in cases if case.overrides not in [*tried, *of_low]] == []


def test_a_change_that_is_not_in_the_study_is_refused(evidence):
    with pytest.raises(ValueError, match="has no case .*height"):
        evidence.changed({"block.height_mm": 77.0})


def test_a_run_that_stopped_is_not_handed_out():
    result = made_up_result()
    stopped = replace(result, summary=result.summary | {"status": "not converged", "reason": "x"})
    with pytest.raises(UnfinishedError, match="the example, stopped at 120 mm: x"):
        finished(stopped, "the example")
    assert finished(result, "the example") is result


def test_an_experiment_that_stopped_leaves_the_verdict(evidence):
    class Stopped(Evidence):
        def changed(self, overrides):
            raise UnfinishedError("stopped")

    stopped = Stopped(evidence.directory)
    stopped.introductory = with_summary(made_up_result(), mean_contact_pressure_N_per_mm2=0.4)
    finding = judged(next(c for c in CLAIMS if c.key == "mean_contact_pressure"), stopped)
    assert finding.verdict == DIFFERS
    assert "a free top under uniform pressure: no result (stopped)" in finding.experiment


@pytest.mark.slow
def test_a_real_run_is_judged_by_all_claims_that_need_only_it(tmp_path):
    keys = {"block.mesh": "coarse", "loading.distance_mm": 12.0}
    evidence = Evidence(tmp_path)
    evidence.introductory = simulate(Case.from_toml(BASES["introductory"], keys))
    by_key = {claim.key: judged(claim, evidence) for claim in _of_the_example()}
    assert by_key["front_edge_curls"].holds
    assert by_key["pressure_concentration"].holds
    assert by_key["heated_layer_is_thin"].holds
    assert all(finding.verdict != UNCHECKED for finding in by_key.values())


def _of_the_example():
    """Claims on the introductory run alone, without those that may look for a reason."""
    others = {
        "mean_contact_pressure",
        "temperature_peak_at_edge",
        "diffusion_sets_the_depth",
        "deforms_as_photographed",
    }
    return [claim for claim in CLAIMS if claim.section == "4.2" and claim.key not in others]
