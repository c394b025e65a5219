"""A room is used by what it hands out: no import reaches a file inside another one."""

import ast
from pathlib import Path

ROOT = Path(__file__).parents[1]
#: Packages with rooms in folders; `materials` and `contact` are flat, their files are their rooms.
PACKAGES = ("fem", "calibration", "validation")
FILES = [
    ROOT / "treadfem.py",
    *(p for name in ("contact", *PACKAGES) for p in sorted((ROOT / name).rglob("*.py"))),
]


def room_of(module):
    """The innermost folder that a module lies in, or is."""
    parts = module.split(".")
    return ".".join(parts) if (ROOT / Path(*parts)).is_dir() else ".".join(parts[:-1])


def reached_into(tree, own_room):
    """Modules inside other rooms that a syntax tree imports from."""
    imported = [
        name
        for node in ast.walk(tree)
        for name in (
            [node.module or ""]
            if isinstance(node, ast.ImportFrom)
            else [alias.name for alias in getattr(node, "names", [])]
            if isinstance(node, ast.Import)
            else []
        )
        if name.split(".")[0] in PACKAGES
    ]
    return [
        name
        for name in imported
        if (room := room_of(name)) not in (name, own_room) and not own_room.startswith(f"{room}.")
    ]


def test_no_import_reaches_into_another_room():
    found = {}
    for path in FILES:
        module = ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
        tree = ast.parse(path.read_text(encoding="utf-8"))
        if reached := reached_into(tree, room_of(module)):
            found[module] = reached
    assert found == {}


def test_an_import_that_reaches_into_a_room_is_found():
    tree = ast.parse("from fem.case.reading import read_toml\nfrom fem.case import Case")
    assert reached_into(tree, "fem.results") == ["fem.case.reading"]
    assert reached_into(tree, "fem.case") == []


def test_fem_has_three_files_beside_its_rooms_at_most():
    assert len(list((ROOT / "fem").glob("*.py"))) <= 3
