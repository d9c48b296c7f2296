"""Scores of a measured outline, with their errors, by generalised least squares.

The dots are r = R0 (mean + components . scores) + errors of covariance V:
each dot's own error, a scale error of all radii together, the error of the length that
heights are fractions of, and what the components leave of computed outlines. Then
scores = (B^T V^-1 B)^-1 B^T V^-1 (r - R0 mean), of covariance (B^T V^-1 B)^-1.
"""

from dataclasses import dataclass

import numpy as np

from outlines.basis import OutlineBasis
from outlines.measured import MeasuredOutline


@dataclass
class Projection:
    """scores and sd [mm of radius]; correlation [COMPONENTS x COMPONENTS] of their errors;
    rms of the dots about the outline that the scores stand for, in standard errors."""

    scores: np.ndarray
    sd: np.ndarray
    correlation: np.ndarray
    rms: float


def project(
    measured: MeasuredOutline,
    basis: OutlineBasis,
    shape: str,
    initial_diameter_mm: float,
    scale_sd: float,
) -> Projection:
    """`scale_sd`: standard error of the radii's common scale, relative."""
    of_shape = basis.shapes[shape]
    first_radius = initial_diameter_mm / 2
    at = np.clip(measured.height_mm / measured.length_mm, 0, 1)
    mean = np.interp(at, basis.fractions, of_shape.mean)
    components = _at_heights(of_shape.components, basis.fractions, at).T
    radii = measured.radius_mm / first_radius

    own = np.diag((measured.radius_sd_mm / first_radius) ** 2)
    scale = scale_sd**2 * np.outer(radii, radii)
    left = _at_heights(_at_heights(of_shape.truncation, basis.fractions, at).T, basis.fractions, at)
    errors = own + scale + left
    scores, _ = _least_squares(components, radii - mean, errors)
    # The length moves the heights: dr = -r'(z/L) (z/L) dL/L.
    slope = np.gradient(basis.outline(shape, scores, basis.fractions), basis.fractions)
    moved = np.interp(at, basis.fractions, slope) * at
    moved *= measured.length_sd_mm / measured.length_mm
    errors += np.outer(moved, moved)

    scores, covariance = _least_squares(components, radii - mean, errors)
    residual = radii - mean - components @ scores
    sd = np.sqrt(np.diag(covariance))
    freedom = max(len(radii) - len(scores), 1)
    return Projection(
        scores=scores * first_radius,
        sd=sd * first_radius,
        correlation=covariance / np.outer(sd, sd),
        rms=float(np.sqrt(residual @ np.linalg.solve(errors, residual) / freedom)),
    )


def _at_heights(rows: np.ndarray, fractions: np.ndarray, at: np.ndarray) -> np.ndarray:
    return np.array([np.interp(at, fractions, row) for row in rows])


def _least_squares(components, values, errors) -> tuple[np.ndarray, np.ndarray]:
    weighted = np.linalg.solve(errors, components)
    covariance = np.linalg.inv(components.T @ weighted)
    return covariance @ weighted.T @ values, covariance
