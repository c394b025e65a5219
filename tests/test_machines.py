"""The command line on machines that fail it: disks, streams, memory, folders, other programs."""

from __future__ import annotations

import contextlib
import resource
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from fem import Case, simulate
from tests.machines import (
    CALIBRATE,
    CASE,
    ENVIRONMENT,
    ROOT,
    contents,
    is_one_line,
    run,
    shell,
    start,
    wait_for,
    without_warnings,
    write_inputs,
)

RUN, SWEEP = ("run", "case.toml"), ("sweep", "study.toml", "--workers", "2")
#: Long enough to be met while it is running.
LONG = ("--set", "loading.distance_mm=400")
INTRODUCTORY = ROOT / "examples" / "introductory.toml"
LIMIT_BYTES = 50_000


def slowly(*values: object) -> list[object]:
    """Parameters of a test that are left to the slow tests."""
    return [pytest.param(value, marks=pytest.mark.slow) for value in values]


@pytest.fixture
def folder(tmp_path):
    write_inputs(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """What the three commands leave where nothing is wrong."""
    place = tmp_path_factory.mktemp("undisturbed")
    write_inputs(place)
    for words, name in ((RUN, "run"), (SWEEP, "sweep"), (CALIBRATE, "fit")):
        code, _, errors = run(place, *words, "-o", name)
        assert code == 0, errors
    return place


@contextlib.contextmanager
def small_disk(folder: Path, size: str) -> Iterator[Path]:
    """A disk of a given size."""
    disk = folder / "disk"
    disk.mkdir()
    words = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(disk)]
    try:
        mounted = subprocess.run(words, capture_output=True, check=False).returncode == 0
    except OSError:
        mounted = False
    if not mounted:
        pytest.skip("a disk can be mounted by the superuser only")
    try:
        yield disk
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def larger(disk: Path) -> None:
    """Give a disk more room."""
    subprocess.run(["mount", "-o", "remount,size=50m", str(disk)], check=True)


def small_files() -> None:
    """Limit the size of the files of a process that is about to start."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT_BYTES, LIMIT_BYTES))


# -- disks -----------------------------------------------------------------------------------------


def test_run_on_a_full_disk_keeps_its_checkpoint_and_goes_on_from_it(folder, undisturbed):
    with small_disk(folder, "120k") as disk:
        code, _, errors = run(folder, *RUN, "-o", "disk/run")
        assert (code, is_one_line(errors)) == (2, True), errors
        assert "no space left on the disk" in errors
        assert [path.name for path in (disk / "run").iterdir()] == ["checkpoint.npz"]
        larger(disk)
        code, printed, errors = run(folder, *RUN, "-o", "disk/run", "--resume")
        assert (code, errors) == (0, "")
        assert "going on from" in printed
        assert contents(disk / "run") == contents(undisturbed / "run")


@pytest.mark.slow
def test_sweep_on_a_full_disk_says_so_and_goes_on_when_there_is_room(folder, undisturbed):
    with small_disk(folder, "250k") as disk:
        code, _, errors = run(folder, *SWEEP, "-o", "disk/sweep")
        assert code in (2, 3)
        assert "Traceback" not in errors
        larger(disk)
        code, _, errors = run(folder, *SWEEP, "-o", "disk/sweep", "--resume")
        assert (code, errors) == (0, "")
        assert contents(disk / "sweep") == contents(undisturbed / "sweep")


@pytest.mark.parametrize("words", [RUN, CALIBRATE], ids=["run", "calibrate"])
def test_limit_of_the_file_size_gives_one_line_and_keeps_what_was_there(words, folder, undisturbed):
    (folder / "out").mkdir()
    (folder / "out" / "parameters.toml").write_text("earlier")
    code, _, errors = run(folder, *words, "-o", "out", preexec_fn=small_files)
    assert (code, is_one_line(errors)) == (2, True), errors
    assert "larger than the system allows" in errors
    assert (folder / "out" / "parameters.toml").read_text() == "earlier"
    assert not [path for path in (folder / "out").iterdir() if path.name.startswith(".")]
    (folder / "out" / "parameters.toml").unlink()
    resume = ["--resume"] if words == RUN else []
    assert run(folder, *words, "-o", "out", *resume)[0] == 0
    name = "run" if words == RUN else "fit"
    assert contents(folder / "out") == contents(undisturbed / name)


@pytest.mark.slow
def test_disk_that_becomes_read_only_during_a_run_gives_one_line(folder):
    """Another disk that nobody may write appears in the place of the folder."""
    out = folder / "out"
    with start(folder, *RUN, *LONG, "-o", "out") as process:
        wait_for((out / "checkpoint.npz").exists, process)
        words = ["mount", "-t", "tmpfs", "-o", "ro", "tmpfs", str(out)]
        if subprocess.run(words, capture_output=True, check=False).returncode:
            process.kill()
            pytest.skip("a disk can be mounted by the superuser only")
        try:
            process.send_signal(signal.SIGINT)
            errors = without_warnings(process.communicate(timeout=60)[1])
        finally:
            subprocess.run(["umount", str(out)], check=True)
    assert (process.returncode, is_one_line(errors)) == (2, True), errors
    assert "read-only" in errors
    code, printed, errors = run(folder, *RUN, *LONG, "-o", "out", "--resume")
    assert (code, errors) == (0, "")
    assert "going on from" in printed


@pytest.mark.slow
def test_folder_that_vanishes_during_a_run_is_made_again(folder):
    words = ("--set", "loading.distance_mm=60")
    with start(folder, *RUN, *words, "-o", "out") as process:
        wait_for((folder / "out" / "checkpoint.npz").exists, process)
        (folder / "out").rename(folder / "away")
        errors = without_warnings(process.communicate(timeout=60)[1])
    assert (process.returncode, errors) == (0, "")
    assert (folder / "out" / "summary.json").exists()


# -- streams ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "redirection",
    ["| head -2", "> /dev/full", *slowly(">&-", "2>&-", "> /dev/full 2>&1", "<&- >&- 2>&-")],
)
def test_run_ends_whatever_becomes_of_what_it_prints(redirection, folder, undisturbed):
    text = f"T run case.toml -o out {redirection}; echo $? ${{PIPESTATUS[0]}} > codes"
    _, _, errors = shell(folder, text)
    assert (folder / "codes").read_text().split() == ["0", "0"]
    assert "Traceback" not in errors
    assert errors.count("\n") <= 1
    assert contents(folder / "out") == contents(undisturbed / "run")


@pytest.mark.parametrize("verb", ["check case.toml", *slowly("template")])
@pytest.mark.parametrize("redirection, code", [("> /dev/full", 2), (">&-", 2), ("| true", 0)])
def test_output_that_is_the_result_is_not_lost_silently(verb, redirection, code, folder):
    found, _, errors = shell(folder, f"set -o pipefail; T {verb} {redirection}")
    assert found == code
    assert is_one_line(errors) if code else errors == ""


def test_terminal_without_the_letters_of_a_path_gets_escapes(folder):
    (folder / "grün.toml").write_text(CASE)
    environment = {**ENVIRONMENT, "PYTHONIOENCODING": "ascii"}
    code, printed, errors = run(folder, "run", "grün.toml", "-o", "weiß", env=environment)
    assert (code, errors) == (0, "")
    assert "results in wei\\u00df" in printed
    assert (folder / "weiß" / "summary.json").exists()
    code, _, errors = run(folder, "run", "gelböd.toml", env=environment)
    assert (code, is_one_line(errors)) == (2, True)


# -- memory ----------------------------------------------------------------------------------------

# Lets a run have no more memory than it has after three steps.
LITTLE_MEMORY = """
import resource, sys
import treadfem
from fem.stepping import progress as run_progress
show, steps = run_progress.RunProgress.__call__, []

def limited(self, state):
    steps.append(state)
    if len(steps) == 3:
        pages = int(open("/proc/self/statm").read().split()[0])
        limit = pages * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    show(self, state)

run_progress.RunProgress.__call__ = limited
sys.exit(treadfem.main(sys.argv[1:]))
"""
FINE = ("--set", "block.mesh=fine", "--set", "loading.distance_mm=0.5", "--set", "output.vtu=false")


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="needs /proc")
def test_run_out_of_memory_keeps_its_steps_and_goes_on(folder):
    words = [*RUN, *FINE, "-o", "out", "--quiet"]
    command = [sys.executable, "-c", LITTLE_MEMORY, *words]
    done = subprocess.run(
        command, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, check=False
    )
    assert (done.returncode, is_one_line(without_warnings(done.stderr))) == (3, True), done.stderr
    assert "out of memory" in done.stderr
    assert len((folder / "out" / "history.csv").read_text().splitlines()) >= 3
    assert (folder / "out" / "checkpoint.npz").exists()
    assert run(folder, *words, "--resume") == (0, "", "")
    assert run(folder, *RUN, *FINE, "-o", "whole", "--quiet")[0] == 0
    assert contents(folder / "out") == contents(folder / "whole")


@pytest.mark.parametrize("rigid", [False, True])
def test_simulation_out_of_memory_hands_back_its_steps(rigid, folder):
    case = Case.from_toml(folder / "case.toml", {"block.rigid": rigid})
    steps = []

    def short(state):
        steps.append(state)
        if len(steps) == 3:
            raise MemoryError

    result = simulate(case, progress=short, checkpoint=folder / "checkpoint")
    assert result.summary["status"] == "stopped"
    assert result.summary["reason"] == "out of memory"
    assert len(result.history) == 3
    again = simulate(case, checkpoint=folder / "checkpoint", resume=True)
    assert again.summary["status"] == "ok"
    assert any(line.startswith("resumed after 3 steps") for line in again.log)


def test_machine_without_memory_for_the_model_is_said_in_one_line(folder, monkeypatch, capsys):
    import treadfem

    def too_large(*_, **__):
        raise MemoryError

    monkeypatch.setattr("fem.simulate", too_large)
    assert treadfem.main(["run", str(folder / "case.toml"), "-o", str(folder / "out")]) == 2
    errors = capsys.readouterr().err
    assert is_one_line(errors)
    assert "out of memory" in errors
    assert not (folder / "out").exists()


# -- places ----------------------------------------------------------------------------------------

COMMANDS = {
    "run": RUN,
    "sweep": SWEEP,
    "calibrate": CALIBRATE,
    "figure": ("figure", "7"),
    "table": ("table", "3"),
    "compare": ("compare", "rig.csv", "."),
    "claims": ("claims",),
    "sensitivity": ("sensitivity",),
    "report": ("report", "--figures", "."),
    "export": ("export", "case.toml"),
}


def called(folder: Path, monkeypatch, capsys, *words: str) -> tuple[int, str]:
    """Exit code and standard error of a command in this process."""
    import treadfem

    monkeypatch.chdir(folder)
    code = treadfem.main(words)
    return code, capsys.readouterr().err


@pytest.mark.parametrize("output", ["", "link", "link/more", "taken/more", "x" * 300])
@pytest.mark.parametrize("name", COMMANDS)
def test_place_that_cannot_be_is_refused_before_anything_is_done(
    name, output, folder, monkeypatch, capsys
):
    (folder / "link").symlink_to(folder / "nowhere")
    (folder / "taken").write_text("mine")
    before = sorted(folder.rglob("*"))
    code, errors = called(folder, monkeypatch, capsys, *COMMANDS[name], "-o", output)
    assert (code, is_one_line(errors)) == (2, True), errors
    assert sorted(folder.rglob("*")) == before


KINDS = [
    *(("run", name, True) for name in ("summary.json", "history.csv", "checkpoint.npz")),
    ("run", "figures", False),
    *(("sweep", name, True) for name in ("summary.csv", "timings.csv")),
    ("sweep", "runs", False),
    ("calibrate", "parameters.toml", True),
    ("calibrate", "fit.csv", True),
    ("figure", "made", False),
    ("figure", "runs", False),
]


@pytest.mark.parametrize("name, entry, is_folder", KINDS)
def test_folder_for_a_file_and_file_for_a_folder_are_refused(
    name, entry, is_folder, folder, monkeypatch, capsys
):
    place = folder / "out" / entry
    (place if is_folder else place.parent).mkdir(parents=True)
    if not is_folder:
        place.write_text("mine")
    before = sorted((folder / "out").rglob("*"))
    code, errors = called(folder, monkeypatch, capsys, *COMMANDS[name], "-o", "out")
    assert (code, is_one_line(errors)) == (2, True), errors
    assert entry in errors
    assert sorted((folder / "out").rglob("*")) == before


def test_current_folder_that_is_gone_gives_one_line(folder):
    text = f"mkdir gone; cd gone; rmdir ../gone; T run {folder}/case.toml; T check case.toml"
    code, _, errors = shell(folder, text)
    assert code == 2
    assert errors.count("the current folder is gone\n") + errors.count(", expected") == 2
    assert errors.count("\n") == 2


@pytest.mark.parametrize(
    "make",
    [
        lambda: simulate({"loading": {}}),
        lambda: simulate(Case.from_toml(INTRODUCTORY), progress=5),
        lambda: simulate(Case.from_toml(INTRODUCTORY), checkpoint=5),
    ],
)
def test_wrong_types_are_named(make):
    with pytest.raises(TypeError, match=r"^(case|progress|checkpoint) is a (dict|int), expected"):
        make()


# -- two at once -----------------------------------------------------------------------------------

SECOND = {
    "run and resume": (RUN, (*RUN, "--resume")),
    "sweep and sweep": (SWEEP, (*SWEEP, "--resume")),
    "run and run": (RUN, RUN),
    "run and sweep": (RUN, SWEEP),
    "sweep and figure": (SWEEP, ("figure", "7")),
    "run and calibrate": (RUN, CALIBRATE),
}


@pytest.mark.parametrize("pair", ["run and resume", "sweep and sweep", *slowly(*SECOND)[2:]])
def test_second_program_in_a_folder_is_refused_in_one_line(pair, folder):
    first, second = SECOND[pair]
    (folder / "case.toml").write_text(CASE.replace("6.0", "400.0"))
    with start(folder, *first, "-o", "out") as process:
        wait_for((folder / "out" / ".lock").exists, process)
        code, _, errors = run(folder, *second, "-o", "out")
        assert process.poll() is None, "the first one has ended already"
        process.kill()
        own = without_warnings(process.communicate(timeout=60)[1])
    assert (code, is_one_line(errors)) == (2, True), errors
    assert "another run that is using it" in errors
    assert own == ""


def test_lock_of_a_killed_run_is_no_obstacle(folder):
    with start(folder, *RUN, *LONG, "-o", "out") as process:
        wait_for((folder / "out" / "checkpoint.npz").exists, process)
        process.kill()
    assert (folder / "out" / ".lock").exists()
    code, _, errors = run(folder, *RUN, "-o", "out")
    assert (code, errors) == (0, "")
    assert not (folder / "out" / ".lock").exists()


def test_remains_of_a_killed_run_are_cleaned_up_by_the_next(folder, undisturbed):
    for place in ("out", "out/figures"):
        (folder / place / ".unfinished-abc").mkdir(parents=True)
        (folder / place / ".unfinished-abc" / "half.csv").write_text("x")
        (folder / place / ".unfinished-def.npz").write_text("x")
    assert run(folder, *RUN, "-o", "out")[0] == 0
    assert contents(folder / "out") == contents(undisturbed / "run")


# -- requests to end -------------------------------------------------------------------------------


@pytest.mark.parametrize("number", [signal.SIGTERM, *slowly(signal.SIGHUP, signal.SIGINT)])
def test_request_to_end_writes_what_was_accepted_and_resume_goes_on(number, folder):
    (folder / "case.toml").write_text(CASE.replace("6.0", "40.0"))
    with start(folder, *RUN, "-o", "out") as process:
        wait_for((folder / "out" / "checkpoint.npz").exists, process)
        process.send_signal(number)
        errors = without_warnings(process.communicate(timeout=60)[1])
    assert (process.returncode, is_one_line(errors)) == (130, True), errors
    assert '"status": "interrupted"' in (folder / "out" / "summary.json").read_text()
    assert run(folder, *RUN, "-o", "out", "--resume")[0] == 0
    assert run(folder, *RUN, "-o", "whole")[0] == 0
    assert contents(folder / "out") == contents(folder / "whole")


def test_many_requests_at_once_lose_nothing(folder):
    """Eight Ctrl-C within 0.4 s."""
    with start(folder, *RUN, *LONG, "-o", "out") as process:
        wait_for((folder / "out" / "checkpoint.npz").exists, process)
        for _ in range(8):
            process.send_signal(signal.SIGINT)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(0.05)
        errors = without_warnings(process.communicate(timeout=60)[1])
    assert (process.returncode, is_one_line(errors)) == (130, True), errors
    assert '"status": "interrupted"' in (folder / "out" / "summary.json").read_text()
    assert not [path for path in (folder / "out").iterdir() if path.name.startswith(".")]


@pytest.mark.slow
def test_program_in_the_background_ignores_what_it_was_told_to_ignore(folder):
    def deaf() -> None:
        signal.signal(signal.SIGHUP, signal.SIG_IGN)

    with start(folder, *RUN, "-o", "out", preexec_fn=deaf) as process:
        wait_for((folder / "out" / ".lock").exists, process)
        process.send_signal(signal.SIGHUP)
        process.communicate(timeout=60)
    assert process.returncode == 0
