"""What do measurements say of a few numbers? Ordinary least squares, with the covariance of what it finds."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Regression", "regress"]

Array = NDArray[np.float64]
_ALIKE = 1e7
"""Condition number, columns scaled to one length, beyond which the unknowns cannot be told apart in double numbers."""


class Regression(NamedTuple):
    """values : (k,), and covariance : (k, k), of the unknowns. residual : measured less fitted, (n,).

    condition : of the regressors, columns scaled to one length. freedom : n - k.
    """

    values: Array
    covariance: Array
    residual: Array
    condition: float
    freedom: int

    @property
    def distinct(self) -> bool:
        """Whether the unknowns can be told apart at all."""
        return self.condition < _ALIKE

    @property
    def errors(self) -> Array:
        """Standard errors of the unknowns, (k,)."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def correlation(self) -> float | None:
        """Between the two unknowns; None if there is one."""
        if len(self.values) != 2:
            return None
        both = float(np.sqrt(self.covariance[0, 0] * self.covariance[1, 1]))
        return float(self.covariance[0, 1]) / both if both > 0.0 else None


def regress(X: Array, y: Array, held: Array, held_covariance: Array) -> Regression:
    """x of least |y - X x|, with covariance s^2 (X^T X)^-1, s^2 = |residual|^2 / (n - k).

    X : regressors, (n, k), n > k. y : measured, (n,); what held unknowns give is taken off before.
    held : regressors of unknowns that other measurements gave, (n, m), and their covariance, (m, m): it is carried
    into that of x through dx/dheld = -(X^T X)^-1 X^T held.
    """
    n, k = X.shape
    length = np.linalg.norm(X, axis=0)
    scale = np.where(length > 0.0, length, 1.0)
    U, s, Vt = np.linalg.svd(X / scale, full_matrices=False)
    condition = float(s[0] / s[-1]) if s[-1] > 0.0 else float("inf")
    inverse = Vt.T * np.where(s > 0.0, 1.0 / np.where(s > 0.0, s, 1.0), 0.0)  # X^+ = inverse U^T / scale
    values = inverse @ (U.T @ y) / scale
    residual = y - X @ values
    variance = float(residual @ residual) / (n - k)
    covariance = variance * (inverse @ inverse.T) / np.outer(scale, scale)
    slope = -(inverse @ (U.T @ held)) / scale[:, None]
    return Regression(values, covariance + slope @ held_covariance @ slope.T, residual, condition, n - k)
