"""A fixed sparsity pattern that element matrices are summed into, and row operations on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


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
    indices: IntArray
    indptr: IntArray
    slots: IntArray

    @classmethod
    def from_elements(cls, element_dofs: IntArray, size: int) -> SparsePattern:
        """Pattern of elements with the equation numbers `element_dofs` (ne, k); < 0 is dropped."""
        k = element_dofs.shape[1]
        rows = np.repeat(element_dofs, k, axis=1).ravel()
        columns = np.tile(element_dofs, (1, k)).ravel()
        kept = (rows >= 0) & (columns >= 0)
        key = columns[kept] * size + rows[kept]
        diagonal = np.arange(size) * (size + 1)
        unique = np.unique(np.concatenate([key, diagonal]))
        slots = np.full(rows.size, unique.size)
        slots[kept] = np.searchsorted(unique, key)
        indptr = np.searchsorted(unique // size, np.arange(size + 1))
        return cls(size, unique % size, indptr, slots)

    @property
    def nnz(self) -> int:
        """Number of stored entries."""
        return int(self.indices.size)

    def sum(self, element_matrices: FloatArray) -> FloatArray:
        """Data array of the assembled matrix from (ne, k, k) element matrices."""
        return summed(self.slots, element_matrices.ravel(), self.nnz + 1)[: self.nnz]

    def matrix(self, data: FloatArray) -> csc_matrix:
        """The matrix with this pattern and the given data (shared, not copied)."""
        matrix = csc_matrix((data, self.indices, self.indptr), shape=(self.size, self.size))
        matrix.has_sorted_indices = True
        return matrix

    def diagonal_slots(self) -> IntArray:
        """Positions of the diagonal entries in the data array, (size,)."""
        columns = np.repeat(np.arange(self.size), np.diff(self.indptr))
        return np.flatnonzero(columns == self.indices)

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
