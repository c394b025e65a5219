"""What a command loads before it does anything."""

import subprocess
import sys

import pytest

HEAVY = ("numpy", "scipy", "pandas", "skfem", "meshio", "matplotlib", "pydantic")


@pytest.mark.parametrize(
    ("words", "loaded"),
    [
        (["--help"], []),
        (["run", "--help"], []),
        (["check", "case.toml"], ["numpy", "pydantic"]),
    ],
    ids=" ".join,
)
def test_commands_load_the_packages_they_need_only(words, loaded, tmp_path):
    (tmp_path / "case.toml").write_text(
        "[loading]\nmean_pressure_N_per_mm2 = 0.3\nvelocity_mm_per_s = 300\ndistance_mm = 5\n"
    )
    program = (
        "import sys, treadfem\n"
        f"try: treadfem.main({words!r})\n"
        "except SystemExit: pass\n"
        f"print(*(name for name in {HEAVY!r} if name in sys.modules), file=sys.stderr)\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, check=True, capture_output=True, text=True
    )
    assert ended.stderr.split() == loaded
