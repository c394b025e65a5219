"""The quantities that claims and figures compare, on fields of which they are known."""

from __future__ import annotations

import numpy as np
import pytest

from fem.results.result import Result
from materials.compounds import COMPOUNDS
from materials.hyperelastic import NeoHooke, Yeoh
from tests.made_up_result import HEIGHT, LENGTH, made_up_result
from tests.validation.claims.made_up_evidence import at, curled, with_snapshot, with_surface
from validation.analysis.paper_numbers import SIMILAR
from validation.analysis.ranges import relative_range
from validation.analysis.rubber_curves import (
    secant_shear_modulus,
    stiffening,
    stiffer_ranges,
    upturn_stretch,
)
from validation.analysis.shape import (
    amount_of_shear,
    deformation,
    detached_length,
    extreme_place,
    interior_pressure,
    rolled_length,
    stress_extremes,
)
from validation.analysis.warmth import (
    cell_rises,
    column_below_peak,
    half_space_depth,
    heated_depth,
    mean_difference,
    surface_gradient,
)


@pytest.fixture
def result() -> Result:
    return made_up_result()


def displaced(result: Result, u_x, u_y) -> Result:
    X = result.geometry.points
    both = np.broadcast_arrays(u_x(*X.T), u_y(*X.T), X[:, 0])[:2]
    return with_snapshot(result, displacement=np.column_stack(both).astype(float))


def test_a_shift_deforms_by_its_length_wherever_nodes_are_dense(result):
    shifted = displaced(result, lambda x, y: 3.0, lambda x, y: 4.0)
    assert deformation(shifted) == pytest.approx(5.0)


def test_the_contour_is_weighted_by_length(result):
    bottom_only = displaced(result, lambda x, y: 1.0 * (y == 0.0), lambda x, y: 0.0)
    share = LENGTH / (LENGTH + 2.0 * HEIGHT)
    assert deformation(bottom_only) == pytest.approx(share, abs=0.01)


def test_simple_shear_is_found(result):
    sheared = displaced(result, lambda x, y: 0.3 * (y - HEIGHT), lambda x, y: 0.0)
    assert amount_of_shear(sheared) == pytest.approx(0.3)


def test_only_the_face_that_lies_on_the_road_counts_as_rolled(result):
    still = displaced(result, lambda x, y: 0.0, lambda x, y: 0.0)
    assert rolled_length(still) == 0.0
    Y = result.geometry.points[:, 1]
    lowest = np.sort(np.unique(Y))
    assert rolled_length(curled(still)) == pytest.approx(lowest[lowest < 0.6].max())


def test_the_leading_face_is_on_the_left_of_a_block_that_slides_left(result):
    still = displaced(result, lambda x, y: 0.0, lambda x, y: 0.0)
    left = at(still, -300.0)
    assert rolled_length(displaced(left, lambda x, y: 0.0, lambda x, y: -y * (x == 0))) > 0.0
    assert rolled_length(displaced(left, lambda x, y: 0.0, lambda x, y: -y * (x == 20))) == 0.0


def test_detached_is_what_is_off_the_road_in_the_leading_fifth(result):
    # The made-up bottom is in contact up to 17 mm of 20.
    assert detached_length(result) == pytest.approx(3.0, abs=0.2)
    assert detached_length(with_surface(result, in_contact=True)) == 0.0


def test_the_interior_is_behind_the_leading_fifth(result):
    X = result.surface["X_mm"].to_numpy()
    peaked = with_surface(result, pressure_N_per_mm2=np.where(X > 17.0, 9.0, X / LENGTH))
    assert interior_pressure(peaked) == pytest.approx(0.8, abs=0.03)


def test_extremes_and_their_places(result):
    place = result.geometry.points[result.geometry.cells].mean(axis=1)
    stress = result.snapshots[-1].cauchy_stress.copy()
    stress[:, 1] = place[:, 0] / LENGTH - 0.5
    stressed = with_snapshot(result, cauchy_stress=stress)
    assert stress_extremes(stressed) == pytest.approx((-0.5, 0.5), abs=0.02)
    assert extreme_place(stressed, 0)[0] == pytest.approx(0.0, abs=0.02)
    assert extreme_place(stressed, 1)[0] == pytest.approx(1.0, abs=0.02)
    assert extreme_place(at(stressed, -300.0), 1)[0] == pytest.approx(0.0, abs=0.02)


def warm(result: Result, depth: float) -> Result:
    Y = result.geometry.points[:, 1]
    return with_snapshot(result, temperature=20.0 + 30.0 * np.exp(-Y / depth))


def test_depth_and_gradient_of_an_exponential_layer(result):
    layer = warm(result, 1.0)
    assert heated_depth(layer) == pytest.approx(np.log(10.0), rel=0.01)
    depth, T = column_below_peak(layer)
    step = depth[1]
    assert T[0] == pytest.approx(30.0)
    assert surface_gradient(layer) == pytest.approx(30.0 * (1.0 - np.exp(-step)) / step)


def test_a_block_that_is_warm_throughout_has_no_thin_layer(result):
    assert heated_depth(warm(result, 1e9)) == pytest.approx(HEIGHT)
    rises, area = cell_rises(warm(result, 1e9))
    assert rises == pytest.approx(30.0)
    assert area.sum() == pytest.approx(LENGTH * HEIGHT)


def test_difference_of_curves_does_not_depend_on_the_nodes(result):
    assert mean_difference(result, result) == 0.0
    assert mean_difference(
        result, with_surface(result, T_C=result.surface["T_C"] + 2.0)
    ) == pytest.approx(2.0)


def test_half_space_depth_solves_the_heat_equation(result):
    """A constant flux, by finite differences in depth: 10 % of the surface's rise is there."""
    rubber, loading = result.case.rubber, result.case.loading
    diffusivity = rubber.thermal.conductivity / (
        rubber.thermal.density * rubber.thermal.specific_heat
    )
    time = loading.distance_mm / loading.velocity_mm_per_s
    z = np.linspace(0.0, 3.0, 301)
    dz, steps = z[1], 4000
    fourier = diffusivity * time / steps / dz**2
    assert fourier < 0.5
    T = np.zeros(z.size)
    for _ in range(steps):
        left = np.append(T[1] + 2.0 * dz, T[:-1])
        right = np.append(T[1:], 0.0)
        T = T + fourier * (left - 2.0 * T + right)
    expected = np.interp(-0.1 * T[0], -T, z)
    assert half_space_depth(result) == pytest.approx(expected, rel=0.01)


def test_a_neo_hookean_rubber_never_stiffens():
    assert stiffening(NeoHooke(G=1.0)) == pytest.approx(1.0)
    assert upturn_stretch(NeoHooke(G=1.0)) == np.inf


def test_a_stiffening_rubber_turns_up_earlier_the_larger_its_cubic_term():
    early, late = Yeoh(C10=0.4, C30=0.02), Yeoh(C10=0.4, C30=0.002)
    assert 1.0 < upturn_stretch(early) < upturn_stretch(late) < np.inf


def test_secant_modulus_starts_at_the_shear_modulus():
    for model in COMPOUNDS.values():
        assert secant_shear_modulus(model, 1e-6) == pytest.approx(
            model.initial_shear_modulus, rel=1e-4
        )


def test_ranges_in_which_a_model_is_stiffer():
    stiffening_one, constant = Yeoh(C10=0.3, C20=0.1), NeoHooke(G=0.8)
    # 2 (C10 + 2 C20 shear^2) = G at shear^2 = 0.5
    ((low, high),) = stiffer_ranges(stiffening_one, constant)
    assert low == pytest.approx(np.sqrt(0.5), abs=0.01)
    assert high == 2.0
    ((low, high),) = stiffer_ranges(constant, stiffening_one)
    assert (low, high) == (0.0, pytest.approx(np.sqrt(0.5), abs=0.01))
    assert stiffer_ranges(constant, constant) == []


def test_similar_is_the_range_of_table_4():
    assert pytest.approx((4.86 - 4.10) / 4.48) == SIMILAR
    assert relative_range([-3.0, -1.0]) == pytest.approx(1.0)
