"""Events of phases with one fault each."""

from __future__ import annotations

from tests.wrong_inputs.cases import WrongCase

PRESS = 'kind = "press"\nmean_pressure_N_per_mm2 = 0.25\n'
SLIDE = 'kind = "slide"\nvelocity_mm_per_s = 300.0\ndistance_mm = 5.0\n'
LIFT = 'kind = "lift"\ntime_s = 0.1\n'


def event(*phases: str, top: str = "") -> str:
    return f"[loading]\n{top}\n" + "".join(f"[[loading.phase]]\n{phase}\n" for phase in phases)


def wrong(
    name: str, content: str, key: str, found: str, expected: str = "", *overrides: str
) -> WrongCase:
    return WrongCase(
        name=f"event: {name}", content=content, key=key, found=found, expected=expected,
        overrides=overrides,
    )  # fmt: skip


GOOD = event(PRESS, SLIDE, LIFT)
PYRO = "[pyrometer]\ngap_mm = 5\n"

EVENTS = [
    wrong("no phases at all", "[loading]\nphase = []\n", "loading.mean_pressure", "nothing", "key"),
    wrong(
        "one number for phases", "[loading]\nphase = 3\n", "loading.phase", "3", "array of tables"
    ),
    wrong("numbers for phases", "[loading]\nphase = [1, 2]\n", "loading.phase.0", "1", "press"),
    wrong("no kind", event("time_s = 1.0\n"), "loading.phase.0.kind", "nothing", "slide"),
    wrong("unknown kind", event('kind = "roll"\n'), "loading.phase.0.kind", '"roll"', "lift"),
    wrong(
        "misspelt key", event(PRESS + "times = 1.0\n", SLIDE), "phase.0.times", "unknown", "time_s"
    ),
    wrong("key of another kind", event(PRESS, LIFT + "distance_mm = 3.0\n"), "phase.1", "unknown"),
    wrong("slide from the air", event(SLIDE), "phase.0.kind", "not pressed", '"press" before'),
    wrong("lift from the air", event(LIFT), "phase.0.kind", "not pressed", '"press" before'),
    wrong("slide after a lift", event(PRESS, SLIDE, LIFT, SLIDE), "phase.3.kind", "not pressed"),
    wrong("twice lifted", event(PRESS, SLIDE, LIFT, LIFT), "phase.3.kind", "not pressed"),
    wrong("nothing slides", event(PRESS, LIFT), "loading.phase", "no phase that slides", "slide"),
    wrong(
        "held only",
        event(PRESS, 'kind = "slide"\nvelocity_mm_per_s = 0.0\ntime_s = 1.0\n'),
        "loading.phase",
        "no phase that slides",
    ),
    wrong("no pressure", event('kind = "press"\n', SLIDE), "phase.0.mean_pressure", "nothing"),
    wrong(
        "pressure in kPa",
        event(PRESS.replace("0.25", "250.0"), SLIDE),
        "phase.0.mean_pressure",
        "kPa",
        "N/mm^2",
    ),
    wrong("negative pressure", event(PRESS.replace("0.25", "-0.25"), SLIDE), "phase.0", "-0.25"),
    wrong(
        "no length",
        event(PRESS, 'kind = "slide"\nvelocity_mm_per_s = 3.0\n'),
        "distance",
        "neither",
    ),
    wrong(
        "two lengths", event(PRESS, SLIDE + "time_s = 1.0\n"), "phase.1.distance_mm", "both", "one"
    ),
    wrong(
        "0 over a distance", GOOD.replace("300.0", "0.0"), "velocity", "0 over a distance", "time_s"
    ),
    wrong("speed of light", GOOD.replace("300.0", "3e11"), "phase.1.velocity", "3", "mm/s"),
    wrong("no time in air", event(PRESS, SLIDE, 'kind = "lift"\n'), "phase.2.time_s", "nothing"),
    wrong("negative time", GOOD.replace("0.1", "-0.1"), "phase.2.time_s", "-0.1", "at least"),
    wrong("time that is not finite", GOOD.replace("0.1", "inf"), "phase.2.time_s", "inf"),
    wrong(
        "negative film",
        event(PRESS, SLIDE, LIFT + "convection_W_per_m2K = -1.0\n"),
        "convection",
        "-1",
    ),
    wrong(
        "lift of a free top", event(PRESS, SLIDE, LIFT, top='top = "pressure"'), "phase.2", "lift"
    ),
    wrong("no repeat", event(PRESS, SLIDE, top="repeat = 0"), "loading.repeat", "0", "at least 1"),
    wrong(
        "half a repeat", event(PRESS, SLIDE, top="repeat = 1.5"), "loading.repeat", "1.5", "whole"
    ),
    wrong("too many", event(PRESS, SLIDE, top="repeat = 15000"), "loading.repeat", "15000 times 2"),
    wrong(
        "unknown road", event(PRESS, SLIDE, top='road = "wet"'), "loading.road", '"wet"', "fresh"
    ),
    wrong(
        "slide beside phases", event(PRESS, SLIDE, top="distance_mm = 5.0"), "distance_mm", "5.0"
    ),
    wrong(
        "repeat without phases",
        GOOD.split("[[")[0] + "repeat = 2\nmean_pressure_N_per_mm2 = 0.2\n"
        "velocity_mm_per_s = 3.0\ndistance_mm = 1.0\n",
        "loading.repeat",
        "2",
        "phase",
    ),
    wrong(
        "a phase that is not there",
        GOOD,
        "loading.phase.7",
        "7",
        "0 to 2",
        "loading.phase.7.time_s=1",
    ),
    wrong(
        "a phase by name",
        GOOD,
        "loading.phase.lift",
        "lift",
        "0 to 2",
        "loading.phase.lift.time_s=1",
    ),
    wrong("pyrometer without a spot", GOOD + PYRO, "pyrometer.spot_mm", "nothing", "this key"),
    wrong("pyrometer on the road", GOOD + PYRO.replace("5", "-5"), "pyrometer.gap_mm", "-5", "0"),
    wrong(
        "gap in micrometres",
        GOOD + PYRO.replace("5", "50000"),
        "pyrometer.gap_mm",
        "50000.0, which looks like micrometres (50 mm)",
        "from 0 to 10000 mm",
    ),
    wrong("spot of a metre", GOOD + PYRO + "spot_mm = 1000\n", "spot_mm", "1000", "to 200 mm"),
    wrong("spot of no number", GOOD + PYRO + "spot_mm = nan\n", "spot_mm", "nan", "finite"),
    wrong("misspelt spot", GOOD + PYRO + "spot = 2\n", "pyrometer.spot", "unknown", "spot_mm"),
    wrong("two pyrometers", GOOD + "[[pyrometer]]\n", "pyrometer", "array", "a table of keys"),
    wrong(
        "block that stands before the pyrometer",
        event(PRESS, SLIDE, 'kind = "slide"\nvelocity_mm_per_s = 0.0\ntime_s = 1.0\n', LIFT)
        + PYRO
        + "spot_mm = 2\n",
        "pyrometer",
        "a block that stands at the end of its last contact",
        "slides",
    ),
    wrong("wear that gives", GOOD + "[wear]\ncoefficient_mm3_per_J = -1.0\n", "wear.coeff", "-1"),
]
