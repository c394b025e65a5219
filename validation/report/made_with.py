"""Which program made the report (versions, commit, date), and which ones its runs."""

import platform
import subprocess
from collections import Counter
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from fem.files import ROOT, program_version, version_of
from fem.results import SUMMARY_JSON, read_summary

#: Packages whose version decides numbers or pictures.
PACKAGES = (
    "numpy",
    "scipy",
    "scikit-fem",
    "pypardiso",
    "pandas",
    "matplotlib",
    "meshio",
    "pydantic",
    "jinja2",
)


@dataclass(frozen=True, kw_only=True)
class MadeWith:
    """What made a report.

    Attributes
    ----------
    date : str
        Local date and time with the offset from UTC.
    program, commit : str
        From `program_version` and `describe_commit`.
    versions : dict
        Python and packages to their versions.
    """

    date: str
    program: str
    commit: str
    versions: dict[str, str]


def made_with() -> MadeWith:
    """Find out what makes this report."""
    return MadeWith(
        date=datetime.now().astimezone().strftime("%Y-%m-%d %H:%M UTC%z"),
        program=program_version(),
        commit=describe_commit(ROOT),
        versions={"Python": platform.python_version()} | {p: version_of(p) for p in PACKAGES},
    )


def programs_of_runs(directory: Path) -> list[tuple[str, int]]:
    """Programs and how many runs in ``directory/runs`` they computed, most runs first."""
    counts: Counter[str] = Counter()
    for path in sorted((directory / "runs").glob(f"*/{SUMMARY_JSON}")):
        try:
            counts[str(read_summary(path.parent).get("program_version", "unknown"))] += 1
        except ValueError:
            counts["unreadable"] += 1
    return counts.most_common()


def describe_commit(root: Path) -> str:
    """Commit of a source tree and whether the tree is clean; a tree without git is said to be one.

    A tree that lies inside another repository (an installed package, say) has no commit of its own.
    """
    top = _git(root, "rev-parse", "--show-toplevel")
    commit = _git(root, "rev-parse", "HEAD")
    if top is None or commit is None or Path(top).resolve() != root.resolve():
        return "not from a git repository"
    changes = _git(root, "status", "--porcelain")
    if changes is None:
        return f"{commit} (git could not say whether there are changes)"
    if not changes:
        return f"{commit}, clean tree"
    files = len(changes.splitlines())
    return f"{commit} with {files} uncommitted file{'s' if files > 1 else ''}"


def _git(root: Path, *arguments: str) -> str | None:
    """What git answers; None without git, without a repository or without a commit."""
    command = ["git", "-C", str(root), *arguments]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=30, check=True)
    except (OSError, subprocess.SubprocessError):
        return None
    return done.stdout.strip()
