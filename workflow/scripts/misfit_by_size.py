"""How far the model is off, size by size.

In per cent of the size before impact: one that may vanish, such as the undeformed length,
would make deviations relative to itself meaningless.
"""

from size_kinds import is_radial


def size_before_impact(size: str, specimen: dict) -> float:
    return specimen["initial_diameter_mm" if is_radial(size) else "initial_length_mm"]


def misfit_by_size(comparison: dict, use: str) -> dict[str, float]:
    """Root mean square of measured - predicted over the size before impact."""
    squares: dict[str, list[float]] = {}
    for shot in comparison["shots"]:
        if shot["use"] == use:
            for cell in shot["sizes"]:
                share = cell["residual"] / size_before_impact(cell["size"], shot)
                squares.setdefault(cell["size"], []).append(share**2)
    return {size: (sum(values) / len(values)) ** 0.5 for size, values in squares.items()}
