"""Cost of the heat per mechanics step on the default mesh (about 2,900 cells)."""

from itertools import count

import numpy as np

from fem.heat.model import HeatModel
from fem.heat.state import HeatLoad
from fem.mesh.block import block_mesh
from fem.mesh.grading import NAMED_GRADINGS
from materials.thermal import ASPHALT, RUBBER


def sliding(benchmark, shiver):
    """Benchmark a step of 1 mm (two sub-steps) of a block whose shear changes by `shiver`."""
    mesh = block_mesh(20.0, 8.0, NAMED_GRADINGS["default"])
    model = HeatModel(mesh, RUBBER, ASPHALT)
    lengths = mesh.bottom_lengths
    lag = -2.0 * (1.0 - mesh.points[:, 1] / 8.0) ** 2
    number = count(1)

    def load(step):
        shear = lag * (1.0 + shiver * np.sin(step))
        return HeatLoad(
            dt=1.0 / 300.0,
            sweep=1.0,
            displacement=np.column_stack([shear, np.zeros_like(lag)]),
            contact_nodes=mesh.bottom,
            power=60.0 * lengths,
            conductance=1.6 * lengths,
        )

    state = model.advance(model.initial_state(), load(0), 0.0)
    return benchmark(lambda: model.advance(state, load(next(number)), 1.0))


def test_step_with_a_new_conduction_matrix(benchmark):
    assert sliding(benchmark, 0.2).sub_steps == 4


def test_step_with_the_matrix_of_an_earlier_step(benchmark):
    assert sliding(benchmark, 1e-3).sub_steps == 4
