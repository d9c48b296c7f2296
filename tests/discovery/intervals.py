"""Binomial intervals."""

from scipy.stats import beta


def clopper_pearson(hits: int, trials: int, level: float = 0.95) -> tuple[float, float]:
    """Exact interval of a share; 0 to 1 when nothing was tried."""
    tail = (1 - level) / 2
    lowest = beta.ppf(tail, hits, trials - hits + 1) if hits > 0 else 0.0
    highest = beta.ppf(1 - tail, hits + 1, trials - hits) if hits < trials else 1.0
    return float(lowest), float(highest)
