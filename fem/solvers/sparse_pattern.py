"""A fixed sparsity pattern that element matrices are summed into, and row operations on it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csc_matrix

from materials.arrays import FloatArray, Int32Array, IntArray


@dataclass(frozen=True)
class SparsePattern:
    """Compressed-column pattern of a finite element matrix.

    Element entries whose row or column number is negative (prescribed degrees of freedom) are
    dropped. The pattern holds the whole diagonal.

    Attributes
    ----------
    size : int
        Number of equations.
    indices, indptr : int arrays
        Row numbers and column starts, rows sorted within each column.
    slots : int array
        Position in the data array of every element entry; ``nnz`` for a dropped one.
    """

    size: int
    indices: Int32Array
    indptr: Int32Array
    slots: IntArray

    @classmethod
    def from_entries(cls, rows: IntArray, columns: IntArray, size: int) -> SparsePattern:
        """Pattern of element entries with these row and column numbers; < 0 is dropped."""
        rows, columns = rows.ravel(), columns.ravel()
        kept = (rows >= 0) & (columns >= 0)
        key = columns[kept] * size + rows[kept]
        diagonal = np.arange(size) * (size + 1)
        unique = np.unique(np.concatenate([key, diagonal]))
        slots = np.full(rows.size, unique.size)
        slots[kept] = np.searchsorted(unique, key)
        indptr = np.searchsorted(unique // size, np.arange(size + 1))
        # 32-bit, as the solver needs them: else every matrix would convert them again.
        return cls(size, (unique % size).astype(np.int32), indptr.astype(np.int32), slots)

    @property
    def nnz(self) -> int:
        """Number of stored entries."""
        return int(self.indices.size)

    @cached_property
    def columns(self) -> IntArray:
        """Column number of every stored entry."""
        return np.repeat(np.arange(self.size), np.diff(self.indptr))

    def sum(self, element_matrices: FloatArray) -> FloatArray:
        """Data array of the assembled matrix from element entries in the order of the pattern."""
        return summed(self.slots, element_matrices.ravel(), self.nnz + 1)[: self.nnz]

    def matrix(self, data: FloatArray) -> csc_matrix:
        """The matrix with this pattern and the given data (shared, not copied)."""
        matrix = csc_matrix((data, self.indices, self.indptr), shape=(self.size, self.size))
        matrix.has_sorted_indices = True
        return matrix

    def diagonal_slots(self) -> IntArray:
        """Positions of the diagonal entries in the data array, (size,)."""
        return np.flatnonzero(self.columns == self.indices)

    def row_slots(self, rows: IntArray) -> tuple[IntArray, IntArray]:
        """Positions of all entries of the given rows, and the number of the row in `rows` of each.

        Entries come row by row and sorted by column, so that two rows with equal column sets
        give positions that pair up one to one.
        """
        order = np.full(self.size, -1)
        order[rows] = np.arange(rows.size)
        slots = np.flatnonzero(order[self.indices] >= 0)
        owner = order[self.indices[slots]]
        by_row = np.argsort(owner, kind="stable")
        return slots[by_row], owner[by_row]


def summed(places: IntArray, values: FloatArray, size: int) -> FloatArray:
    """Sum `values` into an array of the given size at `places`."""
    return np.bincount(places, weights=values, minlength=size).astype(np.float64, copy=False)
