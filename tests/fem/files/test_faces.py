"""What a room's face says it hands out is there, and is loaded only when it is asked for."""

from __future__ import annotations

import ast
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import fem

FACES = sorted(Path(str(fem.__file__)).parent.glob("*/__init__.py"))


def names_of(init: Path) -> list[str]:
    statements = [s for s in ast.walk(ast.parse(init.read_text())) if isinstance(s, ast.ImportFrom)]
    return [alias.name for s in statements if s.module.startswith("fem.") for alias in s.names]


@pytest.mark.parametrize("init", FACES, ids=lambda path: path.parent.name)
def test_every_name_of_a_face_is_there_and_is_no_file_of_the_room(init):
    room = import_module(f"fem.{init.parent.name}")
    for name in names_of(init):
        assert getattr(room, name) is not None
        # A file of the same name would hide it as soon as it is loaded.
        assert not (init.parent / f"{name}.py").exists() or init.parent.name == "sweeps"


def test_a_name_that_is_not_handed_out_is_no_attribute():
    with pytest.raises(AttributeError, match=r"'fem\.results' has no attribute 'Nothing'"):
        import_module("fem.results").Nothing  # noqa: B018


def test_a_face_loads_nothing_by_itself():
    words = (
        "import sys, fem, fem.case, fem.results, fem.stepping\n"
        "print([m for m in ('numpy', 'pandas', 'pydantic', 'scipy', 'skfem') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", words], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
