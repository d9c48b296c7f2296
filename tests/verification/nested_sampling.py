"""Nested sampling in plain numpy (Skilling 2006, doi 10.1214/06-BA127).

Debian has no package of it, and the method is short: live points climb in likelihood, each
step shrinks the prior volume by a known factor, and the evidence is the sum of likelihood
times shrinkage. New points come from a few live points at a time by slice sampling along the
live points' principal directions, which copes with narrow ridges.
"""

import numpy as np


class NestedSampling:
    """Evidence and weighted points of a likelihood over the unit cube."""

    def __init__(self, log_likelihood, dimensions: int, live: int = 200, seed: int = 1):
        self.log_likelihood = log_likelihood
        self.random = np.random.default_rng(seed)
        self.points = self.random.random((live, dimensions))
        self.heights = log_likelihood(self.points)
        self.calls = live

    def run(self, batch: int = 50, remaining: float = 1e-3):
        """Returns ln Z, its standard error, points and weights. `batch`: of the live points
        that are replaced together; `remaining`: share of Z that the last live points may hold.
        """
        live = len(self.points)
        dead, dead_heights, log_widths = [], [], []
        log_volume, log_z = 0.0, -np.inf
        while self.heights.max() + log_volume > log_z + np.log(remaining):
            order = np.argsort(self.heights)
            for rank, worst in enumerate(order[:batch]):
                shrink = 1 / (live - rank)  # the lowest of those that are left
                dead.append(self.points[worst].copy())
                dead_heights.append(self.heights[worst])
                log_widths.append(log_volume + np.log(shrink))
                log_volume += np.log1p(-shrink)
                log_z = np.logaddexp(log_z, dead_heights[-1] + log_widths[-1])
            self._replace(order[:batch], order[batch:])
        dead += list(self.points)
        dead_heights += list(self.heights)
        log_widths += [log_volume - np.log(live)] * live
        log_weights = np.array(dead_heights) + np.array(log_widths)
        log_z = np.logaddexp.reduce(log_weights)
        weights = np.exp(log_weights - log_z)
        information = weights @ (np.array(dead_heights) - log_z)
        return log_z, np.sqrt(information / live), np.array(dead), weights

    def _replace(self, out: np.ndarray, stay: np.ndarray, steps: int = 8) -> None:
        """New points above the highest that went, all at once."""
        floor = self.heights[out].max()
        root = np.linalg.cholesky(
            np.cov(self.points[stay].T) + 1e-14 * np.eye(self.points.shape[1])
        )
        starts = self.random.choice(stay, len(out))
        points, heights = self.points[starts].copy(), self.heights[starts].copy()
        for _ in range(steps):
            direction = self.random.normal(size=points.shape) @ root.T
            low = -2.0 * self.random.random(len(out))
            high = low + 2.0
            moving = np.arange(len(out))
            while len(moving):
                along = self.random.uniform(low[moving], high[moving])
                trial = points[moving] + along[:, None] * direction[moving]
                inside = ((trial > 0) & (trial < 1)).all(axis=1)
                height = np.full(len(moving), -np.inf)
                if inside.any():
                    height[inside] = self.log_likelihood(trial[inside])
                    self.calls += int(inside.sum())
                good = height > floor
                points[moving[good]], heights[moving[good]] = trial[good], height[good]
                below = along < 0
                low[moving[~good & below]] = along[~good & below]
                high[moving[~good & ~below]] = along[~good & ~below]
                moving = moving[~good]
        self.points[out], self.heights[out] = points, heights
