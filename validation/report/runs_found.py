"""Which programs computed the runs that lie in a folder of figures."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from fem.results import SUMMARY_JSON, read_summary


def programs_of_runs(directory: Path) -> list[tuple[str, int]]:
    """Programs and how many runs in ``directory/runs`` they computed, most runs first."""
    counts: Counter[str] = Counter()
    for path in sorted((directory / "runs").glob(f"*/{SUMMARY_JSON}")):
        try:
            counts[str(read_summary(path.parent).get("program_version", "unknown"))] += 1
        except ValueError:
            counts["unreadable"] += 1
    return counts.most_common()
