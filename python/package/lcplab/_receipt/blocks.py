"""A symmetric matrix by its independent diagonal blocks: small ones, where a dense matrix of all of them is slow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Rows = NDArray[np.int64]


@dataclass(frozen=True)
class Blocks:
    """Blocks of the same size together: their columns, (blocks, size), and entries, (blocks, size, size)."""

    groups: list[tuple[Rows, Array]]

    @classmethod
    def of(cls, triplets: tuple[Rows, Rows, Array], size: int) -> Blocks:
        """From the entries of the upper triangle.

        Examples
        --------
        >>> whole = Blocks.of((np.array([0, 0, 1, 2]), np.array([0, 1, 1, 2]), np.array([2.0, 1.0, 2.0, 4.0])), 3)
        >>> [columns.tolist() for columns, _ in whole.groups]
        [[[2]], [[0, 1]]]
        >>> whole.solve(np.array([3.0, 3.0, 4.0])).tolist()
        [1.0, 1.0, 1.0]
        """
        rows, columns, values = triplets
        reach = np.arange(size)
        np.maximum.at(reach, rows, columns)
        last = np.flatnonzero(np.maximum.accumulate(reach) == np.arange(size))
        first = np.concatenate([[0], last[:-1] + 1]).astype(np.int64)
        sizes = last - first + 1 if size else np.zeros(0, dtype=np.int64)
        block = np.searchsorted(last, rows)
        groups = []
        for own in np.unique(sizes):
            numbers = np.flatnonzero(sizes == own)
            place = np.full(len(sizes), -1)
            place[numbers] = np.arange(len(numbers))
            mine = place[block] >= 0
            at, start = place[block[mine]], first[block[mine]]
            entries = np.zeros((len(numbers), own, own))
            entries[at, rows[mine] - start, columns[mine] - start] = values[mine]
            entries[at, columns[mine] - start, rows[mine] - start] = values[mine]
            groups.append((first[numbers][:, None] + np.arange(own), entries))
        return cls(groups)

    def is_definite(self) -> bool:
        """Whether all blocks are positive definite, up to rounding."""
        try:
            for _, entries in self.groups:
                np.linalg.cholesky(entries)
        except np.linalg.LinAlgError:
            return False
        return True

    def plus_diagonal(self, diagonal: Array) -> Blocks:
        """M + diag(diagonal)."""
        def added(columns: Rows, entries: Array) -> Array:
            return entries + diagonal[columns][:, :, None] * np.eye(columns.shape[1])

        return Blocks([(columns, added(columns, entries)) for columns, entries in self.groups])

    def solve(self, right: Array) -> Array:
        """M⁻¹ right, for a vector (k,) or a matrix (k, n)."""
        found = np.zeros(right.shape)
        for columns, entries in self.groups:
            part = right[columns].reshape(*columns.shape, -1)
            found[columns] = np.linalg.solve(entries, part).reshape(*columns.shape, *right.shape[1:])
        return found
