"""The equations of the block: numbers of the unknowns, rows of the contact, matrix.

Everything is written in the platen's frame: the block's top does not move along x, the road moves
below it by ``-sweep`` in a step. Equations and unknowns are the free displacements; the common
vertical displacement of the platen is one of them. For a rigid plane the normal constraint of a
node in contact replaces its vertical equation, its reaction is the nodal force of that equation,
and Coulomb friction is the row operation ``row_x + s mu row_y`` (s: sense of the slip).
"""

from typing import Literal

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix

from contact.active_set import ContactStatus
from contact.pair_search import Boundary
from fem.mechanics.elements import Q1P0Elements, tangent_entries
from fem.mechanics.iterate import StepLoad
from fem.mesh import BlockMesh
from fem.solvers import LinearSolver, SparsePattern, SuperLUSolver, nested_dissection, summed
from materials.arrays import FloatArray, IntArray


class BlockEquations:
    """Equations of a block between platen and road: their numbers, and the rows of the contact.

    Parameters
    ----------
    mesh : BlockMesh
        Reference mesh.
    elements : Q1P0Elements
        Element kernel on that mesh.
    density : float
        Mass density [t/mm^3]; zero for quasi-static steps.
    top : {"platen", "pressure"}
        Rigid platen, or free uniform pressure with fixed horizontal displacement.
    tolerance : float
        Force residual [N/mm] that counts as converged.
    """

    def __init__(
        self,
        mesh: BlockMesh,
        elements: Q1P0Elements,
        *,
        density: float = 0.0,
        top: Literal["platen", "pressure"] = "platen",
        tolerance: float = 1e-8,
        solver: LinearSolver | None = None,
    ) -> None:
        self.mesh, self.elements, self.top = mesh, elements, top
        self.tolerance = tolerance
        self.solver: LinearSolver = solver or SuperLUSolver()
        n = len(mesh.points)
        self.mass = np.bincount(
            mesh.cells.ravel(), np.repeat(density * elements.volume / 4.0, 4), minlength=n
        )
        self.candidates = mesh.candidates
        size = mesh.node_size[mesh.boundary]
        self.boundary = Boundary.of(
            mesh.boundary, mesh.direction, mesh.points, size, joined=mesh.joined
        )
        self._number_equations()
        self.top_load = np.zeros(n)
        self.top_load[mesh.top] = mesh.top_shares

    def _number_equations(self) -> None:
        """Equation numbers of all dofs (-1: prescribed), in a fill-reducing order."""
        mesh, platen = self.mesh, self.top == "platen"
        free = np.ones((len(mesh.points), 2), dtype=bool)
        free[mesh.top, 0] = False
        free[mesh.top, 1] = not platen
        # The mirror image of a mesh has the same order.
        order = nested_dissection(mesh.points * [mesh.direction, 1.0], mesh.cells)
        dof = np.full(free.shape, -1)
        dof[order] = np.where(free[order], np.cumsum(free[order]).reshape(-1, 2) - 1, -1)
        size = int(free.sum()) + platen
        if platen:
            # Coupled with all nodes of the top, so it comes last.
            dof[mesh.top, 1] = size - 1
        self.equation = dof
        self.pattern = SparsePattern.from_entries(*tangent_entries(dof[mesh.cells]), size)
        self._diagonal = self.pattern.diagonal_slots()
        rows = self.equation[self.candidates]
        self._slots_x, self._owner = self.pattern.row_slots(rows[:, 0])
        self._slots_y, _ = self.pattern.row_slots(rows[:, 1])
        self._slots_platen, _ = self.pattern.row_slots(np.array([size - 1]))
        self._numbered = dof.ravel() >= 0

    @property
    def size(self) -> int:
        """Number of equations."""
        return self.pattern.size

    def gather(self, nodal: FloatArray) -> FloatArray:
        """Sum nodal values (n, 2) into the equations, (size,)."""
        return summed(
            self.equation.ravel()[self._numbered],
            nodal.ravel()[self._numbered],
            self.pattern.size,
        )

    def scatter(self, x: FloatArray) -> FloatArray:
        """Nodal values (n, 2) of an equation vector; zero where prescribed."""
        return np.where(self.equation >= 0, x[self.equation], 0.0)

    def gap(self, u: FloatArray) -> FloatArray:
        """Distance of the candidates from the road, (m,) [mm]."""
        return np.asarray(self.mesh.points[self.candidates, 1] + u[self.candidates, 1])

    def held(self, status: ContactStatus, load: StepLoad) -> IntArray:
        """Equations of a displacement: gaps (active), slips (sticking), platen (raised)."""
        rows = self.equation[self.candidates]
        held = np.concatenate([rows[status.active, 1], rows[status.sticking, 0]])
        return held if load.raised is None else np.append(held, self.size - 1)

    def add_to_diagonal(self, data: FloatArray, nodal: FloatArray) -> None:
        """Add a value per node (n,) to the diagonal of matrix data, in both directions."""
        data[self._diagonal] += np.bincount(
            self.equation.ravel()[self._numbered],
            np.repeat(nodal, 2)[self._numbered],
            minlength=self.pattern.size,
        )

    def matrix(
        self,
        data: FloatArray,
        pairs: FloatArray | None,
        status: ContactStatus,
        load: StepLoad,
    ) -> csc_matrix:
        """Matrix of the equations: force tangents with the rows of the contact status."""
        matrix = self.pattern.matrix(self._with_contact_rows(data, status, load))
        if pairs is None:
            return matrix
        return (matrix + self._pair_matrix(pairs, status, load)).tocsc()

    def _pair_matrix(
        self, tangents: FloatArray, status: ContactStatus, load: StepLoad
    ) -> csc_matrix:
        """Tangents of self-contact (np, 6, 6) with the row operations of the road contact."""
        pairs = load.pairs
        assert pairs is not None
        pressed = tangents.any(axis=(1, 2))
        K = tangents[pressed]
        equations = self.equation[pairs.nodes[pressed]].reshape(-1, 6)
        row = np.repeat(equations, 6, axis=1).ravel()
        column = np.tile(equations, (1, 6)).ravel()
        kept = (row >= 0) & (column >= 0)
        row, column, value = row[kept], column[kept], K.ravel()[kept]
        rows = self.equation[self.candidates]
        slipping, size = status.slipping, self.pattern.size
        factor, partner = np.zeros(size), np.zeros(size, dtype=np.int64)
        factor[rows[slipping, 1]] = (status.sense * load.mu)[slipping]
        partner[rows[slipping, 1]] = rows[slipping, 0]
        free = np.ones(size, dtype=bool)
        free[self.held(status, load)] = False
        passed = factor[row] != 0.0
        row_to = np.concatenate([row[free[row]], partner[row[passed]]])
        column_to = np.concatenate([column[free[row]], column[passed]])
        value_to = np.concatenate([value[free[row]], (factor[row] * value)[passed]])
        return coo_matrix((value_to, (row_to, column_to)), shape=(size, size)).tocsc()

    def _with_contact_rows(
        self, data: FloatArray, status: ContactStatus, load: StepLoad
    ) -> FloatArray:
        """Matrix data with friction rows, stick rows and gap rows."""
        owner, data = self._owner, data.copy()
        factor = np.where(status.slipping, status.sense * load.mu, 0.0)[owner]
        data[self._slots_x] += factor * data[self._slots_y]
        data[self._slots_x[status.sticking[owner]]] = 0.0
        data[self._slots_y[status.active[owner]]] = 0.0
        if load.raised is not None:
            data[self._slots_platen] = 0.0
        data[self._diagonal[self.held(status, load)]] = self.elements.K_bulk
        return data
