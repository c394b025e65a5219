"""Tests of rubber that no fit of relaxation times or softening can use."""

from __future__ import annotations

from tests.wrong_inputs.rows import WrongInput, table

VISCO = ("calibrate", "viscoelastic", "t.csv", "-o", "out")
NEO = (*VISCO, "--model", "neo-hooke")
MULLINS = ("calibrate", "mullins", "t.csv", "--model", "neo-hooke", "-o", "out")
TIMED = "time_s,stretch,nominal_stress_N_per_mm2\n"
LATER = "".join(f"{t},1.5,{1 + 0.5**t:.4f}\n" for t in range(1, 12))
RELAXED = TIMED + "0,1,0\n0,1.5,2\n" + LATER
CURVE = "stretch,nominal_stress_N_per_mm2,mode\n"
UP = "".join(f"{1 + 0.1 * i:.1f},{0.2 * i:.1f},uniaxial\n" for i in range(8))
SWEEPS = "T_C,frequency_Hz,modulus_N_per_mm2,loss_modulus_N_per_mm2\n"
ONE_SWEEP = "".join(f"20,{f},{2 + 0.1 * i},0.2\n" for i, f in enumerate((0.1, 0.3, 1, 3, 10)))
#: A liquid's moduli.
FLOWING = "".join(
    f"20,{f},{f * f / (1 + f * f):.6f},{f / (1 + f * f):.6f}\n" for f in (0.1, 0.3, 1, 3, 10, 30)
)
#: Stretches with compressive stresses.
AGAINST = "".join(f"{i},{1.1 + i / 10:.1f},{-i}\n" for i in range(8))

#: Kind: command, table, row, column, what the line says.
TABLES: dict[str, tuple[tuple[str, ...], str, int | None, str, str]] = {
    "history without time": (NEO, CURVE + UP, 1, "time_s", "expected a column named time_s"),
    "time that falls": (NEO, RELAXED + "5,1.5,1\n", 15, "time_s", "5 after 11"),
    "time that stands": (
        NEO, TIMED + "".join(f"0,{1 + i / 10},{i / 5}\n" for i in range(6)), 2, "time_s", "one t",
    ),
    "time as text": (NEO, RELAXED + "later,1.5,1\n", 15, "time_s", "'later'"),
    "time of nan": (NEO, RELAXED + "nan,1.5,1\n", 15, "time_s", "'nan'"),
    "history of four rows": (NEO, TIMED + "0,1,0\n0,1.5,2\n1,1.5,1.5\n2,1.5,1.4\n", 5, "stretch",
                             "4 rows of the test"),
    "history without stress": (
        NEO, TIMED + "".join(f"{i},1.5,0\n" for i in range(8)), 2, "nominal", "zero in every",
    ),
    "history of strains": (
        NEO, TIMED + "".join(f"{i},{0.1 * i + 0.1:.1f},{0.2 * i + 0.1:.1f}\n" for i in range(8)),
        2, "stretch", "look like strains",
    ),
    "history of the other sign": (
        NEO, TIMED + AGAINST, 3, "nominal_stress", "expected a positive stress",
    ),
    "history in kelvin": (
        NEO, RELAXED.replace("mm2\n", "mm2,T_C\n", 1).replace("\n", ",293.15\n").replace(
            "T_C,293.15", "T_C"), 2, "T_C", "looks like kelvin",
    ),
    "unknown mode of a history": (
        NEO, RELAXED.replace("mm2\n", "mm2,mode\n", 1).replace("\n", ",shear\n").replace(
            "mode,shear", "mode"), 2, "mode", "'shear'",
    ),
    "cycle that is not there": (
        (*NEO, "--from-cycle", "2"), RELAXED, 1, "cycle", "expected a column named cycle",
    ),
    "cycle beyond the last": (
        (*NEO, "--from-cycle", "9"), RELAXED.replace("mm2\n", "mm2,cycle\n", 1).replace(
            "\n", ",1\n").replace("cycle,1", "cycle"), None, "cycle", "the cycle 9 or later",
    ),
    "elastic history": (
        NEO, TIMED + "".join(
            f"{i},{1 + 0.1 * (i % 5):.1f},{(1 + 0.1 * (i % 5)) - (1 + 0.1 * (i % 5)) ** -2:.6f}\n"
            for i in range(20)),
        None, "", "no relaxation explains better",
    ),
    "more branches than times": (
        (*NEO, "--branches", "9"), RELAXED, None, "", "expected data for 9, or fewer --branches",
    ),
    "softening without a way back": (MULLINS, CURVE + UP, 9, "stretch", "0 rows below an earlier"),
    "softening without stress": (
        MULLINS, CURVE + UP.replace(
            ",0.2,", ",x,"), 3, "nominal_stress", "'x'",
    ),
    "sweep without a modulus": (
        VISCO, "T_C,frequency_Hz,tan_delta\n20,1,0.1\n20,2,0.1\n20,3,0.1\n", 1, "modulus_N_per_mm2",
        "expected a column named modulus_N_per_mm2",
    ),
    "sweep of two frequencies": (
        VISCO, SWEEPS + "20,1,2,0.1\n20,2,2.1,0.1\n", 2, "frequency_Hz", "2 frequencies",
    ),
    "sweep with a modulus of zero": (
        VISCO, SWEEPS + ONE_SWEEP + "20,30,0,0.1\n", 7, "modulus_N_per_mm2", "a modulus from",
    ),
    "sweep without a plateau": (VISCO, SWEEPS + FLOWING, None, "modulus", "no rubbery plateau"),
}  # fmt: skip

#: Kind: options of the command, what the line says.
OPTIONS: dict[str, tuple[tuple[str, ...], str, tuple[str, ...]]] = {
    "vertical shift of a history": ((*NEO, "--vertical", "none"), RELAXED, ("vertical", "sweeps")),
    "elastic law of sweeps": (NEO, SWEEPS + ONE_SWEEP, ("model is 'neo-hooke'", "histories")),
    "half a shift": ((*NEO, "--C1", "7"), RELAXED, ("--C1 and --C2", "expected both or neither")),
    "held modulus of a branch": ((*NEO, "--fix", "g1=1"), RELAXED, ("fixed holds g1", "G")),
}


def _measured(
    kind: str, words: tuple[str, ...], text: str, row: int | None, column: str, part: str
) -> WrongInput:
    places = [f"row {row}"] * (row is not None) + [f"column {column}"] * bool(column)
    return table(f"memory: {kind}", words, text, "found", "expected", *places, part)


def _option(kind: str, words: tuple[str, ...], text: str, parts: tuple[str, ...]) -> WrongInput:
    return WrongInput(kind=f"memory: {kind}", words=words, files={"t.csv": text}, expected=parts)


MEMORY_TESTS = [
    *(_measured(kind, *row) for kind, row in TABLES.items()),
    *(_option(kind, *row) for kind, row in OPTIONS.items()),
]
