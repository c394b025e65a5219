"""The rigid block against independent one-dimensional conduction columns."""

import numpy as np
import pytest

from contact.conductance import GapConductance
from contact.friction import HuemerFriction, shifted
from contact.partition import HeatPartition
from fem.case.case import Case
from fem.heat.model import HeatModel
from fem.mesh.block import block_mesh
from fem.mesh.grading import NAMED_GRADINGS
from fem.stepping.rigid_block import RigidSliding, slide_rigid_block
from materials.thermal import ASPHALT, RUBBER
from materials.wlf import WLF
from tests.reference_solutions.conduction_columns import sliding_columns


def sliding(velocity, pressure, wlf, distance=120.0):
    return RigidSliding(
        pressure=pressure,
        velocity=velocity,
        distance=distance,
        friction=shifted(HuemerFriction(), WLF() if wlf else None, 20.0),
        partition=HeatPartition(),
        conductance=GapConductance(),
    )


def rigid_block(case):
    """T_max and A_T of the heat model; columns do not radiate, so neither does the model here."""
    mesh = block_mesh(20.0, 8.0, NAMED_GRADINGS["default"])
    model = HeatModel(mesh, RUBBER, ASPHALT, emissivity=0.0)
    *_, last = slide_rigid_block(model, case)
    T = last.heat.T[mesh.bottom]
    return T.max(), np.trapezoid(T - 20.0, mesh.from_trailing(mesh.bottom))


def columns(case):
    result = sliding_columns(
        velocity=case.velocity,
        distance=case.distance,
        length=20.0,
        pressure=case.pressure,
        friction=lambda T: case.friction.coefficient(case.pressure, case.velocity, T),
        kappa=float(case.partition(case.pressure)),
        conductance=1e-3 * float(case.conductance.conductance(case.pressure)),
        block=(RUBBER.conductivity, RUBBER.heat_capacity),
        road=(ASPHALT.conductivity, ASPHALT.heat_capacity),
    )
    return result.T_max_C, result.excess_area(20.0, 20.0)


@pytest.mark.parametrize("wlf", [False, True])
@pytest.mark.parametrize("velocity", [7.0, 50.0, 300.0])
@pytest.mark.parametrize("pressure", [0.2, 0.3, 0.4])
def test_rigid_block_matches_conduction_columns(velocity, pressure, wlf):
    """Largest differences measured over the nine points: 0.2 K and 0.3 %."""
    case = sliding(velocity, pressure, wlf)
    T_max, area = rigid_block(case)
    T_max_columns, area_columns = columns(case)
    assert T_max == pytest.approx(T_max_columns, abs=0.5)
    assert area == pytest.approx(area_columns, rel=0.02)


def test_columns_agree_with_themselves_on_finer_cells_and_stations():
    """The reference is converged well inside the tolerance it is used with."""
    options = {
        "velocity": 300.0,
        "distance": 60.0,
        "length": 20.0,
        "pressure": 0.3,
        "friction": lambda T: np.full_like(T, 0.9),
        "kappa": 0.7,
        "conductance": 1.6,
        "block": (RUBBER.conductivity, RUBBER.heat_capacity),
        "road": (ASPHALT.conductivity, ASPHALT.heat_capacity),
    }
    one = sliding_columns(**options)
    other = sliding_columns(**options, stations=200, first_cell=0.005, ratio=1.08)
    assert one.T_max_C == pytest.approx(other.T_max_C, abs=0.15)
    assert one.excess_area(20.0, 20.0) == pytest.approx(other.excess_area(20.0, 20.0), rel=4e-3)


def test_sub_steps_of_half_the_length_change_the_temperature_by_little():
    results = []
    for step in (0.5, 0.25):
        mesh = block_mesh(20.0, 8.0, NAMED_GRADINGS["coarse"])
        model = HeatModel(mesh, RUBBER, ASPHALT, heat_step_mm=step)
        *_, last = slide_rigid_block(model, sliding(300.0, 0.3, True, distance=40.0))
        results.append(last.heat.T)
    assert np.abs(results[0] - results[1]).max() < 0.2


def a_case(velocity):
    return Case.from_dict(
        {
            "loading": {
                "mean_pressure_N_per_mm2": 0.15,
                "velocity_mm_per_s": velocity,
                "distance_mm": 10.0,
            },
            "block": {"rigid": True, "mesh": "coarse"},
        }
    )


def test_steps_add_up_and_the_capped_share_is_reported():
    """Below 0.184 N/mm^2 the partition is capped everywhere."""
    case = a_case(300.0)
    mesh = block_mesh(20.0, 8.0, NAMED_GRADINGS["coarse"])
    steps = list(slide_rigid_block(HeatModel.from_case(case, mesh), RigidSliding.from_case(case)))
    assert steps[-1].distance_mm == pytest.approx(10.0)
    assert steps[-1].time_s == pytest.approx(10.0 / 300.0)
    assert steps[-1].normal_force == pytest.approx(0.15 * 20.0)
    work = sum(step.dissipation for step in steps)
    assert sum(step.capped_dissipation for step in steps) == pytest.approx(work)
    assert steps[-1].heat.generated == pytest.approx(work)
    assert steps[-1].friction_force == pytest.approx(
        3.0 * float(np.average(steps[-1].mu, weights=steps[-1].tributary_mm))
    )
    assert abs(steps[-1].heat.imbalance) < 1e-12 * work


def test_rigid_block_sliding_to_the_left_is_the_mirror_image():
    ends = []
    for direction in (1, -1):
        case = a_case(direction * 300.0)
        mesh = block_mesh(20.0, 8.0, NAMED_GRADINGS["coarse"], direction)
        model = HeatModel.from_case(case, mesh)
        *_, last = slide_rigid_block(model, RigidSliding.from_case(case))
        ends.append(last)
    np.testing.assert_allclose(ends[0].heat.T, ends[1].heat.T, rtol=0.0, atol=1e-10)
    assert ends[1].position_mm == pytest.approx(-10.0)
