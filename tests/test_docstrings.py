"""Examples in docstrings give what they show."""

import doctest
import importlib
import inspect
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = ("materials", "contact", "fem", "calibration", "validation")
MODULES = sorted(
    ".".join(path.relative_to(ROOT).with_suffix("").parts)
    for path in [
        ROOT / "treadfem.py",
        *(p for name in PACKAGES for p in (ROOT / name).rglob("*.py")),
    ]
    if ">>>" in path.read_text(encoding="utf-8")
)


@pytest.mark.parametrize("module", MODULES)
def test_examples_in_docstrings_give_what_they_show(module):
    found = doctest.testmod(importlib.import_module(module))
    assert found.attempted > 0
    assert found.failed == 0


def test_a_wrong_example_is_found():
    wrong = doctest.DocTestParser().get_doctest(">>> 1 + 1\n3\n", {}, "wrong", None, 0)
    assert doctest.DocTestRunner().run(wrong, out=lambda _: None).failed == 1


HANDED_OUT = [
    pytest.param(getattr(package, name), id=f"{package.__name__}.{name}")
    for package in map(importlib.import_module, ("materials", "contact", "fem"))
    for name in getattr(package, "__all__", ("Case", "Result", "simulate"))
    if callable(getattr(package, name)) and not inspect.isabstract(getattr(package, name))
]


@pytest.mark.parametrize("item", HANDED_OUT)
def test_what_a_package_hands_out_has_an_example(item):
    assert ">>>" in (inspect.getdoc(item) or "")
