"""The fingerprint of the program sees what code means, not how it is written or explained."""

from __future__ import annotations

import pytest

from fem.files import version as module
from fem.files.version import fingerprint, program_version

SOURCE = '''"""Radiation."""

SIGMA = 5.67e-8


class Body:
    """A body."""

    emissivity: float = 0.9
    """Of the body."""

    def power(self, T):
        """Power at T [K]."""
        return self.emissivity * SIGMA * T**4  # eq. (3)
'''


@pytest.fixture
def root(tmp_path, monkeypatch):
    """A program of one file, and what a change of its text does to the fingerprint."""
    for package in ("materials", "contact", "fem/sweeps"):
        (tmp_path / package).mkdir(parents=True)
    (tmp_path / "materials" / "body.py").write_text(SOURCE)
    monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.setattr(module, "_NOT_COMPUTING", tmp_path / "fem" / "sweeps")
    yield tmp_path
    program_version.cache_clear()


def version() -> str:
    program_version.cache_clear()
    return program_version()


@pytest.mark.parametrize(
    "old, new",
    [
        ('"""Power at T [K]."""', '"""Radiated power."""'),
        ('        """Power at T [K]."""\n', ""),
        ('"""Of the body."""', '"""Of its surface."""'),
        ("# eq. (3)", "# the law of Stefan and Boltzmann"),
        ("\n\n\nclass", "\n\n# a remark\n\nclass"),
        ("return self.emissivity * SIGMA * T**4", "return (self.emissivity * SIGMA) * T ** 4"),
        ("5.67e-8", "0.0567e-6"),
    ],
)
def test_comments_docstrings_and_layout_do_not_count(old, new, root):
    before = version()
    path = root / "materials" / "body.py"
    assert old in SOURCE
    path.write_text(SOURCE.replace(old, new))
    assert version() == before


@pytest.mark.parametrize(
    "old, new",
    [
        ("5.67e-8", "5.670374419e-8"),
        ("0.9", "1"),
        ("T**4", "T**4.0"),
        ("emissivity * SIGMA", "emissivity + SIGMA"),
        ("SIGMA * T", "T * SIGMA"),
    ],
)
def test_a_changed_constant_or_formula_counts(old, new, root):
    before = version()
    (root / "materials" / "body.py").write_text(SOURCE.replace(old, new))
    assert version() != before


def test_new_and_renamed_files_count_but_those_of_the_sweeps_do_not(root):
    before = version()
    (root / "fem" / "sweeps" / "table.py").write_text("COLUMNS = 3\n")
    assert version() == before
    (root / "fem" / "newton.py").write_text("TOLERANCE = 1\n")
    with_newton = version()
    assert with_newton != before
    (root / "fem" / "newton.py").rename(root / "fem" / "solver.py")
    assert version() not in (before, with_newton)


def test_versions_of_the_numerical_packages_count(root, monkeypatch):
    before = version()
    monkeypatch.setattr(module, "version_of", lambda package, *_: f"{package} 99")
    assert version().split("+")[1] != before.split("+")[1]


def test_of_other_files_every_byte_counts(root):
    path = root / "data.csv"
    path.write_text("T_C\n20\n")
    before = fingerprint([path])
    path.write_text("T_C\n20 \n")
    assert fingerprint([path]) != before
