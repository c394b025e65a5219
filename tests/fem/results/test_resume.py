"""A run that is resumed from any of its checkpoints ends like one that was never interrupted."""

from __future__ import annotations

import shutil

import numpy as np
import pytest

from fem import Case, simulate
from fem.results.checkpoint import CHECKPOINT_FILE, CheckpointError

SMALL = {"cells_x": 24, "cells_y": 8, "smallest_x_mm": 0.4, "smallest_y_mm": 0.3}
#: What depends on the machine's mood.
TIMES = ("wall_s", "solver_s")


#: Rubber with branches and softening.
MEMORY = {
    "viscoelastic": {"g": [1.5, 0.4], "tau_s": [1e-4, 1e-2], "C1": 7.0, "C2_K": 120.0},
    "mullins": {"r": 2.0, "m_N_per_mm2": 0.1},
}
#: Two contacts: the second one finds a used block.
TWO_CONTACTS = {
    "repeat": 2,
    "phase": [
        {"kind": "press", "mean_pressure_N_per_mm2": 0.25},
        {"kind": "slide", "velocity_mm_per_s": 300.0, "distance_mm": 0.3},
        {"kind": "lift", "time_s": 0.02},
    ],
}


def case_of(block, distance, *, rubber=None, loading=None, **solver):
    slide = {
        "mean_pressure_N_per_mm2": 0.25,
        "velocity_mm_per_s": 300.0,
        "distance_mm": distance,
    }
    output = {"snapshots": 3, "checkpoint_s": 0.0, "figures": False}
    return Case.from_dict(
        {
            "loading": loading or slide,
            "block": block,
            "rubber": rubber or {},
            "solver": solver,
            "output": output,
        }
    )


CASES = {
    "rigid": case_of({"rigid": True, "mesh": "coarse"}, 6.0),
    "small": case_of({"mesh": SMALL}, 3.0),
    # Few iterations: steps are rejected, and their damping rises and fades over the checkpoints.
    "with rejected steps": case_of(
        {"mesh": SMALL},
        3.0,
        newton_iterations_max=6,
        viscous_distance_mm=1.0,
        edge_viscous_distance_mm=0.0,
    ),
    "with a memory": case_of({"mesh": SMALL}, 1.0, rubber=MEMORY),
    "an event with a memory": case_of({"mesh": SMALL}, None, rubber=MEMORY, loading=TWO_CONTACTS),
}


class Stopped(Exception):
    """Stands for the end of the process between two steps."""


def uninterrupted(case, folder):
    """Result of a run, and its checkpoints after each step."""
    files = []

    def keep_copy(_):
        files.append(shutil.copy(folder / CHECKPOINT_FILE, folder / f"{len(files) + 1}.npz"))

    return simulate(case, checkpoint=folder / CHECKPOINT_FILE, progress=keep_copy), files


def assert_same(resumed, reference):
    assert resumed.summary["status"] == "ok"
    for table in ("history", "surface", "boundary"):
        one, other = getattr(resumed, table), getattr(reference, table)
        assert (one.dtypes == other.dtypes).all()
        assert list(one.columns) == list(other.columns)
        for name in one:
            if one[name].dtype.kind in "fiu":
                np.testing.assert_allclose(one[name], other[name], rtol=1e-10, atol=1e-10)
            else:
                assert (one[name] == other[name]).all()
    if reference.bottom is not None:
        for name in ("X_mm", "kind", "pressure"):
            one, other = getattr(resumed.bottom, name), getattr(reference.bottom, name)
            np.testing.assert_array_equal(one, other)
    assert list(resumed.summary) == list(reference.summary)
    for key, value in reference.summary.items():
        if isinstance(value, (str, list)):
            assert resumed.summary[key] == value
        elif key not in TIMES:
            assert resumed.summary[key] == pytest.approx(value, rel=1e-10, abs=1e-10), key
    assert resumed.snapshots == reference.snapshots


@pytest.fixture(scope="module", params=list(CASES))
def run(request, tmp_path_factory):
    case, folder = CASES[request.param], tmp_path_factory.mktemp("run")
    result, files = uninterrupted(case, folder)
    assert result.summary["status"] == "ok"
    return case, result, files


def test_a_checkpoint_is_kept_after_each_step(run):
    _, result, files = run
    assert len(files) == result.summary["steps"] > 8


@pytest.mark.parametrize("share", [0.0, 0.25, 0.5, 0.75, 1.0])
def test_a_resumed_run_equals_the_uninterrupted_one(run, share, tmp_path):
    case, reference, files = run
    number = round(share * (len(files) - 1))
    path = shutil.copy(files[number], tmp_path / CHECKPOINT_FILE)
    seen = []
    resumed = simulate(case, checkpoint=path, resume=True, progress=seen.append)
    assert len(seen) == len(files) - 1 - number
    assert any(line.startswith(f"resumed after {number + 1} steps") for line in resumed.log)
    assert_same(resumed, reference)


def test_rejected_steps_are_among_what_is_resumed():
    result = simulate(CASES["with rejected steps"])
    assert result.summary["rejected_steps"] > 0


@pytest.mark.slow
def test_a_long_coarse_run_is_resumed_from_each_of_its_checkpoints(tmp_path):
    case = case_of({"mesh": "coarse"}, 6.0)
    reference, files = uninterrupted(case, tmp_path)
    for file in files:
        assert_same(simulate(case, checkpoint=file, resume=True), reference)


@pytest.mark.slow
def test_a_rolled_under_block_that_touches_itself_is_resumed(tmp_path):
    coulomb = {"friction.law": "coulomb", "friction.mu": 1.2, "friction.wlf": False}
    hard = {"loading.mean_pressure_N_per_mm2": 0.5, **coulomb}
    case = case_of({"mesh": "coarse"}, 40.0).with_overrides(hard)
    reference, files = uninterrupted(case, tmp_path)
    touching = np.flatnonzero(reference.history["self_contact_penetration"] > 0.0)
    for number in (touching[0], touching[len(touching) // 2]):
        assert_same(simulate(case, checkpoint=files[number], resume=True), reference)


def test_a_run_with_pardiso_is_resumed(tmp_path):
    pytest.importorskip("pypardiso")
    case = case_of({"mesh": SMALL}, 1.0, linear_solver="pardiso")
    reference, files = uninterrupted(case, tmp_path)
    assert_same(simulate(case, checkpoint=files[4], resume=True), reference)


def test_a_run_interrupted_again_and_again_equals_the_uninterrupted_one(run, tmp_path):
    case, reference, _ = run
    path = tmp_path / CHECKPOINT_FILE

    def stop_after(count):
        seen = []

        def progress(report):
            seen.append(report)
            if len(seen) == count:
                raise KeyboardInterrupt

        return progress

    for count in (3, 1, 4):
        result = simulate(case, checkpoint=path, resume=True, progress=stop_after(count))
        assert result.summary["status"] == "interrupted"
    assert result.summary["steps"] == 8
    assert_same(simulate(case, checkpoint=path, resume=True), reference)


def test_an_interrupted_run_leaves_a_checkpoint_whatever_the_interval(tmp_path):
    case = CASES["rigid"].with_overrides({"output.checkpoint_s": 1000.0})
    path = tmp_path / CHECKPOINT_FILE

    def stop(_):
        raise KeyboardInterrupt

    simulate(case, checkpoint=path, progress=stop)
    log = simulate(case, checkpoint=path, resume=True).log
    assert any(line.startswith("resumed after 1 steps") for line in log)


def test_an_interrupt_within_a_step_goes_back_to_the_last_finished_one(tmp_path, monkeypatch):
    case, path = CASES["small"], tmp_path / CHECKPOINT_FILE
    reference = simulate(case)
    from fem.stepping.observers.history import HistoryRecorder

    see = HistoryRecorder.see

    def interrupted(self, moment):
        see(self, moment)
        if len(self.rows) == 6:
            raise KeyboardInterrupt

    monkeypatch.setattr(HistoryRecorder, "see", interrupted)
    assert simulate(case, checkpoint=path).summary["status"] == "interrupted"
    monkeypatch.undo()
    resumed = simulate(case, checkpoint=path, resume=True)
    assert any(line.startswith("resumed after 5 steps") for line in resumed.log)
    assert_same(resumed, reference)


def test_a_run_that_does_not_converge_leaves_its_last_step(tmp_path):
    undamped = {"viscous_distance_mm": 0.0, "edge_viscous_distance_mm": 0.0}
    steps = {"step_mm_min": 0.4, "step_mm_initial": 0.4}
    hopeless = {"newton_iterations_max": 4, "tolerance": 1e-10, **steps, **undamped}
    case, path = case_of({"mesh": SMALL}, 2.0, **hopeless), tmp_path / CHECKPOINT_FILE
    first = simulate(case, checkpoint=path)
    assert first.summary["status"] == "not converged"
    assert "sliding" in first.summary["reason"]
    again = simulate(case, checkpoint=path, resume=True)
    for key in ("status", "reason", "steps", "newton_iterations", "rejected_steps"):
        assert again.summary[key] == first.summary[key]


def test_without_a_checkpoint_the_run_starts_from_the_beginning(tmp_path):
    result = simulate(CASES["rigid"], checkpoint=tmp_path / "none.npz", resume=True)
    assert result.summary["status"] == "ok"
    assert not any("resumed" in line for line in result.log)


def test_without_resume_an_old_checkpoint_is_not_used(run, tmp_path):
    case, _, files = run
    path = shutil.copy(files[5], tmp_path / CHECKPOINT_FILE)
    seen = []

    def first_only(report):
        seen.append(report.sliding_distance_mm)
        raise KeyboardInterrupt

    result = simulate(case, checkpoint=path, progress=first_only)
    assert result.summary["steps"] == 1


@pytest.mark.parametrize("rigid", [True, False])
def test_a_foreign_checkpoint_is_refused_before_anything_is_computed(rigid, run, tmp_path):
    case, _, files = run
    path = shutil.copy(files[2], tmp_path / CHECKPOINT_FILE)
    other = case.with_overrides({"heat.ambient_C": 7.0, "block.rigid": rigid})
    seen = []
    with pytest.raises(CheckpointError, match=r"block\.rigid|heat\.ambient_C"):
        simulate(other, checkpoint=path, resume=True, progress=seen.append)
    assert seen == []


def test_the_matrix_of_the_heat_does_not_depend_on_the_steps_before():
    """Steps that differ by rounding share a matrix; which of them made it must not matter."""
    from fem.heat.model import HeatModel
    from fem.stepping.model_parts import mesh_of

    case = CASES["small"]
    mesh = mesh_of(case)
    at_rest = np.zeros_like(mesh.points)
    warm, cold = HeatModel.from_case(case, mesh), HeatModel.from_case(case, mesh)
    dt = 1e-3 / 3.0
    near = dt * (1.0 + 4e-15)
    rhs = np.linspace(0.0, 1.0, len(mesh.points))
    warm._factor(at_rest, near)
    np.testing.assert_array_equal(
        warm._factor(at_rest, dt).factor.solve(rhs), cold._factor(at_rest, dt).factor.solve(rhs)
    )


@pytest.mark.parametrize("edit", ["nan", "text", "shorter", "number"])
def test_a_checkpoint_that_was_edited_is_refused(edit, run, tmp_path):
    case, _, files = run
    path = tmp_path / CHECKPOINT_FILE
    with np.load(files[5]) as archive:
        arrays = {name: archive[name] for name in archive.files}
    name = max((n for n in arrays if n != "about"), key=lambda n: arrays[n].size)
    if edit == "nan":
        arrays[name] = np.full_like(arrays[name], np.nan, dtype=float)
    elif edit == "text":
        arrays[name] = arrays[name].astype(str)
    elif edit == "shorter":
        arrays[name] = arrays[name][:-1]
    else:
        about = arrays["about"].tobytes().replace(b'"rejected": ', b'"rejected": 1')
        about = about.replace(b'"distance": ', b'"distance": 1')
        arrays["about"] = np.frombuffer(about, dtype=np.uint8)
    np.savez(path, **arrays)
    with pytest.raises(CheckpointError, match="changed after it was written") as refusal:
        simulate(case, checkpoint=path, resume=True)
    assert "\n" not in str(refusal.value)
