"""Records of a rig with one fault each, and what the error must name."""

from tests.wrong_inputs.cases import WrongCase

HEADER = "time_s,velocity_mm_per_s,mean_pressure_N_per_mm2\n"
CASE = '[loading]\n[[loading.phase]]\nkind = "record"\nfile = "signals.csv"\n'
TWO = "time_s,velocity_mm_per_s\n"
GOOD = [f"{0.001 * k:g},300,0.25" for k in range(20)]


def wrong(name: str, found: str, expected: str, rows: list[str], header: str = HEADER) -> WrongCase:
    text = header + "".join(f"{row}\n" for row in rows)
    key = "loading.phase.0.file"
    beside = {"signals.csv": text}
    return WrongCase(
        name=f"record {name}", content=CASE, key=key, found=found, expected=expected, beside=beside
    )


def changed(row: int, text: str) -> list[str]:
    return [*GOOD[:row], text, *GOOD[row + 1 :]]


SIGNALS = [
    WrongCase(
        name="record that is not there", content=CASE, key="loading.phase.0.file",
        found="no such file", expected="a readable CSV file",
    ),
    WrongCase(
        name="record without a file", content='[loading]\n[[loading.phase]]\nkind = "record"\n',
        key="loading.phase.0.file", found="nothing", expected="this key",
    ),
    WrongCase(
        name="record in another unit", content=CASE.replace("file", "csv"),
        key="loading.phase.0.csv", found="an unknown key", expected="file",
    ),
    wrong("without pressure", "without mean_pressure", "time_s", ["0,300"], TWO),
    wrong("of one row", "1 rows", "at least 2", GOOD[:1]),
    wrong("of no rows", "0 rows", "at least 2", []),
    wrong("with a word", "could not convert", "in every row", changed(4, "0.004,fast,0.2")),
    wrong("with a short row", "signals.csv", "a number in every row", changed(4, "0.004,300")),
    wrong("with NaN", "nan as velocity_mm_per_s in row 5", "finite", changed(4, "0.004,nan,0.2")),
    wrong("with an infinite pressure", "inf as mean_pressure", "finite", changed(4, "0.004,1,inf")),
    wrong("with a negative time", "time_s -0.1 in row 1", "0 or more", changed(0, "-0.1,300,0.2")),
    wrong("unsorted", "time_s 0.001 in row 5 after 0.003", "increase", changed(4, "0.001,300,0.2")),
    wrong("with a time twice", "time_s 0.003 in row 5", "increase", changed(4, "0.003,300,0.2")),
    wrong("with a gap", "no row from 0.019 to 0.5 s", "no gap", [*GOOD, "0.5,300,0.2"]),
    wrong("that pulls", "_N_per_mm2 -0.2 in row 5", "0 in air", changed(4, "0.004,300,-0.2")),
    wrong("without any pressure", "no pressure above 0", "on the road", ["0,300,0", "1,300,0"]),
    wrong("that stands", "is 0 throughout", "slides", ["0,0,0.2", "1,0,0.2"]),
    wrong("at 200 m/s", "_per_s 200000 in row 5", "at most", changed(4, "0.004,2e5,0.2")),
]  # fmt: skip
