"""Growth of time and memory with the number of elements, and of time with the distance slid.

CPU times, because the wall time of a machine that others use contains their work. Takes long:
`make bench-scaling`.
"""

from itertools import pairwise

import numpy as np
import pytest

from tests.benchmarks.measured_run import introductory, measured_run

#: Elements of the default mesh, which the others refine or coarsen alike in both directions.
DEFAULT = {"cells_x": 80, "cells_y": 36, "smallest_x_mm": 0.12, "smallest_y_mm": 0.04}
ELEMENTS = (1_000, 3_000, 8_000, 20_000, 50_000)
#: The introductory example is shortened to this distance: pressing, snap and 10 mm of sliding.
SCALING_DISTANCE_MM = 10.0
LONG_SLIDE_MM = 1200.0


def refined(elements: int) -> dict[str, float]:
    """Mesh of about that many elements, graded like the default one."""
    factor = np.sqrt(elements / (DEFAULT["cells_x"] * DEFAULT["cells_y"]))
    return {
        "cells_x": round(DEFAULT["cells_x"] * factor),
        "cells_y": round(DEFAULT["cells_y"] * factor),
        "smallest_x_mm": DEFAULT["smallest_x_mm"] / factor,
        "smallest_y_mm": DEFAULT["smallest_y_mm"] / factor,
    }


def exponent(elements, cost):
    """Slope of the straight line through the logarithms."""
    return float(np.polyfit(np.log(elements), np.log(cost), 1)[0])


def row_of(run):
    """Elements, CPU time, Newton iterations, CPU time per iteration, peak memory."""
    iterations = run["newton_iterations"]
    return [
        run["elements"], run["cpu_s"], iterations, run["cpu_s"] / iterations, run["solver_s"],
        run["peak_memory_GB"],
    ]  # fmt: skip


@pytest.mark.slow
def test_time_and_memory_grow_moderately_with_the_elements(benchmark):
    count, cpu, iterations, each, _, memory = benchmark.pedantic(scaling_table, rounds=1).T
    print(
        f"CPU time grows with elements to the power of {exponent(count, cpu):.2f} "
        f"(iterations {exponent(count, iterations):.2f}, each {exponent(count, each):.2f})"
    )
    assert memory[-1] < 2.0
    assert exponent(count, cpu) < 1.4


def scaling_table():
    """Rows of `row_of`, printed as they come."""
    rows = []
    print(f"\nintroductory example, {SCALING_DISTANCE_MM:g} mm of its slide")
    print("elements   CPU s  iterations  CPU s per iteration  solver s (wall)  peak memory GB")
    for elements in ELEMENTS:
        run = measured_run(introductory(SCALING_DISTANCE_MM, mesh=refined(elements)))
        assert run["status"] == "ok", run["reason"]
        rows.append(row_of(run))
        print("{:8d} {:7.1f} {:11d} {:20.4f} {:16.1f} {:15.2f}".format(*rows[-1]), flush=True)
    return np.array(rows)


@pytest.mark.slow
def test_second_half_of_a_long_slide_costs_no_more_than_the_first(benchmark):
    case = introductory(LONG_SLIDE_MM, mesh="coarse")
    run = benchmark.pedantic(measured_run, (case,), rounds=1)
    assert run["status"] == "ok", run["reason"]
    trace = np.array(run["trace"])
    sliding = trace[trace[:, 0] > 0.0]
    distance, cpu, iterations = sliding.T
    print(f"\n{LONG_SLIDE_MM:g} mm on the coarse mesh, {len(sliding)} steps")
    print("     from       to  CPU ms per mm  iterations per mm")
    marks = np.array([0.0, 0.1, 0.25, 0.5, 0.75, 1.0]) * LONG_SLIDE_MM
    for begin, end in pairwise(marks):
        print("{:9.1f}{:9.1f}{:15.2f}{:19.2f}".format(*cost(distance, cpu, iterations, begin, end)))
    half = LONG_SLIDE_MM / 2.0
    first = cost(distance, cpu, iterations, 0.0, half)[2]
    second = cost(distance, cpu, iterations, half, LONG_SLIDE_MM)[2]
    print(f"second half over first: {second / first:.3f}")
    # The cost must not grow. It may fall: the onset of sliding is in the first half.
    assert second / first < 1.2


def cost(distance, cpu, iterations, begin, end):
    """Begin and end of the accepted steps in a stretch [mm], CPU ms and iterations per mm."""
    first, last = np.searchsorted(distance, [begin, end])
    last = min(last, len(distance) - 1)
    slid = distance[last] - distance[first]
    return (
        distance[first], distance[last], 1e3 * (cpu[last] - cpu[first]) / slid,
        (iterations[last] - iterations[first]) / slid,
    )  # fmt: skip
