"""Validation of the arrays of :meth:`lcplab.EngineStep.of`: shapes, kinds of numbers and settings."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lcplab._lcplab import InputError

if TYPE_CHECKING:
    from lcplab._receipt.step import Step

Array = NDArray[np.float64]
#: The largest relative difference of M from its transpose.
SYMMETRY = 1e-5


class Given:
    """Collects the defects of the arrays; each method returns an array of the right shape, if need be of zeros."""

    def __init__(self) -> None:
        self.defects: list[str] = []

    def end(self) -> None:
        """Raise an InputError with one line for each defect, if there are any."""
        if self.defects:
            raise InputError("\n".join(f"step: {defect}" for defect in self.defects))

    def vector(self, name: str, values: ArrayLike) -> Array:
        """A vector of any length."""
        numbers = self._numbers(name, values)
        if numbers.ndim == 1:
            return numbers
        self.defects.append(f"{name}: has the shape {numbers.shape}, must be a vector")
        return numbers.reshape(-1)

    def array(self, name: str, values: ArrayLike, shape: tuple[int, ...]) -> Array:
        """An array of this shape; without entries it may have another one."""
        numbers = self._numbers(name, values)
        if numbers.shape == shape:
            return numbers
        if numbers.size or np.prod(shape):
            self.defects.append(f"{name}: has the shape {numbers.shape}, must have {shape}")
        return np.zeros(shape)

    def symmetric(self, name: str, values: ArrayLike, size: int) -> Array:
        """A symmetric matrix of this size."""
        matrix = self.array(name, values, (size, size))
        difference = np.abs(matrix - matrix.T)
        if np.any(difference > SYMMETRY * np.abs(matrix).max(initial=0.0)):
            row, column = np.unravel_index(int(np.nanargmax(difference)), matrix.shape)
            self.defects.append(f"{name}: is not symmetric: [{row}, {column}] differs from [{column}, {row}]")
        return matrix

    def rows(self, name: str, values: ArrayLike, n: int) -> Array:
        """One number for each of n rows, or the same for all."""
        numbers = self._numbers(name, values)
        return np.full(n, float(numbers)) if numbers.ndim == 0 else self.array(name, numbers, (n,))

    def normal_rows(self, values: ArrayLike, n: int) -> NDArray[np.int64]:
        """The normal row of each row of friction, -1 for others."""
        index = self.rows("friction_index", values, n)
        is_wrong = (index != np.round(index)) | (index < -1) | (index >= n) | (index == np.arange(n))
        if is_wrong.any():
            row = int(np.argmax(is_wrong))
            self.defects.append(f"friction_index: row {row} names {index[row]:g}, must be another row or -1")
        return np.where(is_wrong, -1, index).astype(np.int64)

    def check_settings(self, step: Step) -> None:
        """The level, bounds, coefficients and reported forces of a step that is otherwise complete."""
        if step.level not in ("velocity", "acceleration"):
            self.defects.append(f"level: is {step.level!r}, must be 'velocity' or 'acceleration'")
        for name, is_wrong, reason in (
            ("lo", step.lo > step.hi, "is above hi"),
            ("compliance", step.compliance < 0, "is negative"),
            ("mu", step.mu < 0, "is negative"),
        ):
            if is_wrong.any():
                self.defects.append(f"{name}: {reason} in row {int(np.argmax(is_wrong))}")
        for name, shape in (
            ("reported_push", step.target.shape),
            ("expected_bias", step.bias.shape),
            ("expected_target", step.target.shape),
        ):
            if getattr(step, name) is not None:
                self.array(name, getattr(step, name), shape)

    def _numbers(self, name: str, values: ArrayLike) -> Array:
        """Real numbers in an array of their own."""
        try:
            numbers = np.array(values)
        except ValueError:  # rows of different lengths
            numbers = np.array(values, dtype=object)
        if numbers.dtype.kind in "biuf" or numbers.size == 0:
            return numbers.astype(float)
        self.defects.append(f"{name}: has the type {numbers.dtype}, must be real numbers of one shape")
        return np.zeros(numbers.shape)
