"""The README and the pages behind it, as one text in the order in which a newcomer follows them."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGES = tuple(
    ROOT / name
    for name in (
        "README.md",
        "docs/running.md",
        "docs/files.md",
        "docs/paper.md",
        "docs/sweeps.md",
        "docs/measurements.md",
        "docs/theory.md",
        "docs/verification.md",
    )
)
TEXT = "\n".join(page.read_text(encoding="utf-8") for page in PAGES)
