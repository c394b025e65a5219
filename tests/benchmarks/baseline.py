"""The committed baseline: reading, comparing, and writing it anew (``make bench-update``).

The kernels that OpenBLAS and numpy pick for a processor round differently, which may move a count:
one of 122 factorisations between those for Zen and for Skylake (``OPENBLAS_CORETYPE``). A margin
covers that; other versions of numpy and scipy have a larger one. Costs are ratios to a reference in
the same session, and may only be worse by a margin.
"""

from __future__ import annotations

import json
import platform
from importlib.metadata import version
from pathlib import Path
from typing import Any

from tests.benchmarks.costs import measured_costs
from tests.benchmarks.counts import RUNS, Counts, counted_run

BASELINE = Path(__file__).with_name("baseline.json")
#: Fraction by which a cost ratio may exceed that of the baseline.
COST_MARGIN = 0.30
#: Fraction by which counts may differ on another processor, and with other numpy or scipy.
PROCESSOR_MARGIN, ROUNDING_MARGIN = 0.02, 0.10

AllCounts = dict[str, Counts]
Costs = dict[str, float]


def versions() -> dict[str, str]:
    """Packages whose rounding decides over the counts."""
    return {name: version(name) for name in ("numpy", "scipy")}


def measured_counts() -> AllCounts:
    """Counts of all runs."""
    return {name: counted_run(case)[1] for name, case in RUNS.items()}


def read_baseline() -> dict[str, Any]:
    """The committed baseline."""
    baseline: dict[str, Any] = json.loads(BASELINE.read_text(encoding="utf-8"))
    return baseline


def count_margin(baseline: dict[str, Any]) -> float:
    """Fraction by which counts may differ, smaller with the baseline's numpy and scipy."""
    return PROCESSOR_MARGIN if versions() == baseline["made_with"]["versions"] else ROUNDING_MARGIN


def different_counts(expected: AllCounts, found: AllCounts, margin: float = 0.0) -> list[str]:
    """One line per count that differs by more than a margin, fewer or more.

    Fewer fail too: an improvement that is not in the baseline could be lost again unseen.
    """
    lines = []
    for run in sorted(expected.keys() | found.keys()):
        before, now = expected.get(run, {}), found.get(run, {})
        for name in sorted(before.keys() | now.keys()):
            old, new = before.get(name), now.get(name)
            if old is None or new is None or abs(new - old) > margin * old:
                lines.append(f"{run}: {name} {old} -> {new}")
    return lines


def worse_costs(expected: Costs, found: Costs, margin: float = COST_MARGIN) -> list[str]:
    """One line per cost that exceeds its baseline by more than the margin, or has none."""
    lines = []
    for name in sorted(expected.keys() | found.keys()):
        old, new = expected.get(name), found.get(name)
        if old is None or new is None or not new <= (1.0 + margin) * old:
            lines.append(f"{name} {_rounded(old)} -> {_rounded(new)}")
    return lines


def _rounded(value: float | None) -> str:
    return "none" if value is None else f"{value:.3f}"


def made_with() -> dict[str, Any]:
    """What a baseline depends on, for its file."""
    return {
        "versions": versions(),
        "python": platform.python_version(),
        "machine": platform.machine(),
        "processor": _processor(),
        "counts": f"within {PROCESSOR_MARGIN:.0%} with these versions of numpy and scipy, "
        f"otherwise within {ROUNDING_MARGIN:.0%}",
        "costs": "CPU time in factorisations of a fixed matrix in the same session; at most "
        f"{COST_MARGIN:.0%} more",
    }


def _processor() -> str:
    """Name of the processor, where the system tells it."""
    information = Path("/proc/cpuinfo")
    lines = information.read_text(encoding="utf-8").splitlines() if information.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor()


def main() -> None:
    """Measure, print what changed, and write the baseline."""
    old = read_baseline() if BASELINE.exists() else {"counts": {}, "costs": {}}
    counts, costs = measured_counts(), measured_costs()
    changed = different_counts(old["counts"], counts)
    changed += [f"{name}: {_rounded(old['costs'].get(name))} -> {_rounded(value)}"
                for name, value in costs.items()]  # fmt: skip
    changed += [f"{name}: no longer measured" for name in old["costs"].keys() - costs.keys()]
    print("\n".join(changed))
    rounded = {name: round(value, 3) for name, value in costs.items()}
    new = {"made_with": made_with(), "counts": counts, "costs": rounded}
    BASELINE.write_text(json.dumps(new, indent=2) + "\n", encoding="utf-8")
    print(f"wrote {BASELINE}")


if __name__ == "__main__":
    main()
