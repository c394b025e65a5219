"""Run CalculiX on a deck."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

#: Name of the program, and the Debian package it comes with.
PROGRAM, PACKAGE = "ccx", "calculix-ccx"


class CalculixError(RuntimeError):
    """CalculiX is missing, or did not reach the end of a deck; one line says why."""


def calculix_program() -> str | None:
    """Path of CalculiX, or None when it is not installed."""
    return shutil.which(PROGRAM)


def run_calculix(deck: str | Path, *, timeout_s: float = 600.0) -> Path:
    """Run CalculiX on one processor.

    Parameters
    ----------
    deck : str or Path
        Input deck; results go into its folder. Its name ends in ``.inp``.
    timeout_s : float
        Longest run time [s].

    Returns
    -------
    Path
        The .dat file.

    Raises
    ------
    CalculixError
        If the program is missing, takes too long, or ends before the deck does.
    """
    path, program = Path(deck), calculix_program()
    if program is None:
        raise CalculixError(f"{PROGRAM} was not found; it is in the Debian package {PACKAGE}")
    if path.suffix != ".inp":
        raise CalculixError(f"{path} is no deck for {PROGRAM}; expected a name ending in .inp")
    results = path.with_suffix(".dat")
    results.unlink(missing_ok=True)
    try:
        done = subprocess.run(
            [program, path.stem],
            cwd=path.parent,
            env=os.environ | {"OMP_NUM_THREADS": "1"},
            capture_output=True,
            text=True,
            errors="replace",
            timeout=timeout_s,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise CalculixError(f"{PROGRAM} took more than {timeout_s:g} s for {path}") from None
    path.with_suffix(".log").write_text(done.stdout + done.stderr, encoding="utf-8")
    if done.returncode != 0 or not results.exists():
        raise CalculixError(f"{PROGRAM} did not finish {path}: {_reason(done.stdout)}")
    return results


def _reason(log: str) -> str:
    """Line of the log that tells the error best."""
    errors = [line.strip() for line in log.splitlines() if "*ERROR" in line]
    return errors[-1] if errors else f"see {PROGRAM}'s log beside the deck"
