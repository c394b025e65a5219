"""Measured tables that no fit can use: what is missing, impossible, or too little."""

from __future__ import annotations

from tests.wrong_inputs.rows import FRICTION as HUEMER
from tests.wrong_inputs.rows import PARTITION as KAPPA
from tests.wrong_inputs.rows import WLF, WrongInput, table

STRESS = "stretch,nominal_stress_N_per_mm2,mode\n"
GOOD = "1.1,0.2,uniaxial\n1.3,0.5,uniaxial\n1.6,0.8,uniaxial\n2.0,1.1,uniaxial\n"
COEFFICIENTS = "p_N_per_mm2,v_mm_per_s,mu\n"
SLIDES = "".join(f"{p},{v},0.9\n" for p in (0.1, 0.3, 0.5) for v in (1, 30, 300))
YEOH = ("calibrate", "hyperelastic", "t.csv", "-o", "out")
PEAKS = "mean_pressure_N_per_mm2,v_mm_per_s,T_max_C\n0.2,300,35\n0.4,300,36\n"
PROFILE = "p_N_per_mm2,v_mm_per_s,X_mm,T_C\n"
PROFILES = "".join(f"{p},300,{x},{30 + x}\n" for p in (0.2, 0.4) for x in (1, 4, 8, 12, 16))

#: Kind: command, table, row, column, what the line says.
BAD: dict[str, tuple[tuple[str, ...], str, int | None, str, str]] = {
    "percent strain": (YEOH, STRESS + "0,0,uniaxial\n50,0.5,uniaxial\n", 2, "stretch", "0"),
    "percent stretch": (YEOH, STRESS + "110,0.1,uniaxial\n150,0.5,uniaxial\n", 2, "stretch", "110"),
    "strain": (
        YEOH,
        STRESS + "0.1,0.1,uniaxial\n0.2,0.2,uniaxial\n0.5,0.5,uniaxial\n0.9,0.6,uniaxial\n",
        2,
        "stretch",
        "these look like strains",
    ),
    "missing column": (YEOH, "stretch,stress,mode\n" + GOOD, 1, "nominal_stress", "stress, mode"),
    "missing mode": (YEOH, "stretch,nominal_stress_N_per_mm2\n1.1,0.2\n", 1, "mode", "column"),
    "unknown mode": (YEOH, STRESS + GOOD + "2.1,1.2,shear\n", 6, "mode", "'shear'"),
    "nan": (YEOH, STRESS + GOOD + "2.1,nan,uniaxial\n", 6, "nominal_stress", "'nan'"),
    "infinite": (YEOH, STRESS + GOOD + "inf,1.2,uniaxial\n", 6, "stretch", "'inf'"),
    "text": (YEOH, STRESS + GOOD + "two,1.2,uniaxial\n", 6, "stretch", "'two'"),
    "decimal comma": (YEOH, STRESS + GOOD + '"2,1",1.2,uniaxial\n', 6, "stretch", "'2,1'"),
    "empty entry": (YEOH, STRESS + GOOD + ",1.2,uniaxial\n", 6, "stretch", "nothing"),
    "short row": (YEOH, STRESS + GOOD + "2.1,1.2\n", 6, "", "2 comma-separated entries"),
    "comment and gap": (YEOH, "# rig 7\n\n" + STRESS + "0,1,uniaxial\n", 4, "stretch", "0"),
    "two points": (YEOH, STRESS + "1.1,0.2,uniaxial\n1.5,0.6,uniaxial\n", 3, "stretch", "2 diff"),
    "one point thrice": (YEOH, STRESS + "1.1,0.2,uniaxial\n" * 3, 4, "stretch", "1 different"),
    "zero stress": (
        YEOH,
        STRESS + "".join(f"{s},0,uniaxial\n" for s in (1.1, 1.2, 1.3, 1.4)),
        2,
        "nominal_stress",
        "zero in every row",
    ),
    "wrong sign": (
        YEOH,
        STRESS + "".join(f"{s},{1 - s},uniaxial\n" for s in (1.1, 1.2, 1.3, 1.4)),
        2,
        "nominal_stress",
        "expected a positive stress",
    ),
    "compression in a tension window": (
        (*YEOH, "--window", "1", "2"),
        STRESS + GOOD + "0.9,-0.2,uniaxial\n",
        6,
        "stretch",
        "tension only",
    ),
    "nothing in the window": (
        (*YEOH, "--window", "3", "4"),
        STRESS + GOOD,
        None,
        "",
        "no row that the selection keeps",
    ),
    "mode without data": ((*YEOH, "--mode", "planar"), STRESS + GOOD, None, "", "no row"),
    "unknown branch": (
        YEOH,
        "stretch,nominal_stress_N_per_mm2,mode,branch\n1.1,0.2,uniaxial,up\n",
        2,
        "branch",
        "'up'",
    ),
    "half a cycle": (
        YEOH,
        "stretch,nominal_stress_N_per_mm2,mode,cycle\n1.1,0.2,uniaxial,1.5\n",
        2,
        "cycle",
        "1.5",
    ),
    "header only": (YEOH, STRESS, None, "", "no rows of data"),
    "column twice": (YEOH, "stretch,stretch,mode\n1,1,uniaxial\n", 1, "stretch", "the name twice"),
    "empty": (YEOH, "", None, "", "no header line"),
    "negative friction": (HUEMER, COEFFICIENTS + SLIDES + "0.3,50,-0.9\n", 11, "mu", "-0.9"),
    "friction in percent": (HUEMER, COEFFICIENTS + SLIDES + "0.3,50,90\n", 11, "mu", "90"),
    "no friction": (
        HUEMER,
        COEFFICIENTS + SLIDES.replace("0.9\n", "0\n"),
        2,
        "mu",
        "zero in every",
    ),
    "zero speed": (HUEMER, COEFFICIENTS + SLIDES + "0.3,0,0.9\n", 11, "v_mm_per_s", "0"),
    "negative pressure": (
        HUEMER,
        COEFFICIENTS + SLIDES + "-0.3,50,0.9\n",
        11,
        "p_N_per_mm2",
        "-0.3",
    ),
    "below absolute zero": (
        HUEMER,
        "p_N_per_mm2,v_mm_per_s,mu,T_C\n0.3,30,0.9,20\n0.3,50,0.9,-280\n",
        3,
        "T_C",
        "-280",
    ),
    "few slides": (HUEMER, COEFFICIENTS + "0.3,30,0.9\n0.3,50,0.9\n", 3, "", "2 usable points"),
    "no temperatures": ((*HUEMER, "--wlf", "fit"), COEFFICIENTS + SLIDES, 1, "T_C", "the columns"),
    "one temperature": (
        (*HUEMER, "--wlf", "fit"),
        "p_N_per_mm2,v_mm_per_s,mu,T_C\n" + SLIDES.replace("0.9\n", "0.9,20\n"),
        None,
        "T_C",
        "one temperature",
    ),
    "peaks without pressure": (
        KAPPA,
        "v_mm_per_s,T_max_C\n300,35\n",
        1,
        "p_N_per_mm2",
        "the columns",
    ),
    "peaks without temperature": (
        KAPPA,
        "p_N_per_mm2,v_mm_per_s,T_C_max\n0.2,300,35\n",
        1,
        "T_max_C",
        "the columns",
    ),
    "profile without place": (
        KAPPA,
        "p_N_per_mm2,v_mm_per_s,T_C\n0.2,300,35\n",
        1,
        "X_mm",
        "the columns",
    ),
    "one pressure": (KAPPA, PEAKS.replace("0.4", "0.2"), 3, "mean_pressure", "1 pressure"),
    "pressure in kPa": (KAPPA, PEAKS + "300,300,35\n", 4, "mean_pressure", "kPa (0.3 N/mm^2)"),
    "zero pressure": (KAPPA, PEAKS + "0,300,35\n", 4, "mean_pressure", "from 1e-06 to 20"),
    "block at rest": (KAPPA, PEAKS + "0.3,0,35\n", 4, "v_mm_per_s", "0"),
    "colder than at the start": (KAPPA, PEAKS + "0.3,300,19\n", 4, "T_max_C", "ambient_C = 20"),
    "peak below absolute zero": (KAPPA, PEAKS + "0.3,300,-300\n", 4, "T_max_C", "-300"),
    "peak in kelvin": (KAPPA, PEAKS + "0.3,300,309\n", 4, "T_max_C", "309"),
    "no peak": (KAPPA, PEAKS + "0.3,300,nan\n", 4, "T_max_C", "'nan'"),
    "sigma of zero": (
        KAPPA,
        PEAKS.replace("_C\n", "_C,sigma_K\n").replace("35\n", "35,0.5\n").replace("36\n", "36,0\n"),
        3,
        "sigma_K",
        "above 0 K",
    ),
    "place off the block": (KAPPA, PROFILE + PROFILES + "0.4,300,21,50\n", 12, "X_mm", "21"),
    "place backwards": (KAPPA, PROFILE + PROFILES + "0.4,300,3,50\n", 12, "X_mm", "ahead"),
    "short profile": (
        KAPPA,
        PROFILE + PROFILES + "0.5,300,3,50\n",
        12,
        "X_mm",
        "1 points of a profile",
    ),
    "cold profile": (
        KAPPA,
        PROFILE + "".join(f"{p},300,{x},15\n" for p in (0.2, 0.4) for x in range(5)),
        2,
        "T_C",
        "at most 15 in 5 rows",
    ),
    "shift factor of zero": (WLF, "T_C,aT\n0,1\n10,0\n20,0.1\n", 3, "aT", "0"),
    "frozen sweeps": (WLF, "T_C,log10_aT\n0,1\n-273.15,0\n20,2\n", 3, "T_C", "-273.15"),
}


def measured(
    kind: str, words: tuple[str, ...], text: str, row: int | None, column: str, part: str
) -> WrongInput:
    places = [f"row {row}"] * (row is not None) + [f"column {column}"] * bool(column)
    return table(f"measured: {kind}", words, text, "found", "expected", *places, part)


MEASURED = [measured(kind, *row) for kind, row in BAD.items()]
