"""Reads a measured outline; messages name the file, the line and the remedy."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from input_errors import InputError, did_you_mean
from table_cells import number_in, read_cells

COLUMNS = ["height_mm", "radius_mm", "radius_sd_mm"]
FEWEST_DOTS = 6  # more than there are components
# Factors of the initial size beyond which a number is in another unit, or another size.
TALLEST, LOWEST = 1.05, 0.25
WIDEST, NARROWEST = 4.0, 0.3


@dataclass
class MeasuredOutline:
    """Dots from the impact face up [mm]; `length_mm` is the final length that heights are
    fractions of, with its standard error."""

    height_mm: np.ndarray
    radius_mm: np.ndarray
    radius_sd_mm: np.ndarray
    length_mm: float
    length_sd_mm: float


def read_outline(row: dict, table: Path, radius_sd_mm: float) -> MeasuredOutline:
    """The outline that a row of the table names; `radius_sd_mm` where the file has none."""
    path = table.parent / row["outline"]
    if not path.exists():
        near = did_you_mean(path.name, [other.name for other in path.parent.glob("*.csv")])
        raise InputError(
            f"{table}, line {row['line']}: outline = {row['outline']!r}: there is no such file "
            f"beside the table. {near}"
        )
    dots, lines = _numbers(path)
    _check_order(path, dots, lines)
    _check_size(path, dots, lines, row)
    height, radius = dots["height_mm"], dots["radius_mm"]
    sd = dots.get("radius_sd_mm", np.full(len(height), radius_sd_mm))
    length = row.get("final_length_mm", height[-1])
    length_sd = row.get("final_length_mm_sd", radius_sd_mm)
    return MeasuredOutline(height, radius, sd, length, length_sd)


def _numbers(path: Path) -> tuple[dict[str, np.ndarray], list[int]]:
    header, records = read_cells(path, "one row a dot")
    for name in header:
        if name not in COLUMNS:
            hint = did_you_mean(name, COLUMNS)
            raise InputError(f"{path}, line 1: column {name!r} is not known. {hint}")
    for name in COLUMNS[:2]:
        if name not in header:
            raise InputError(f"{path}, line 1: column {name!r} is missing. Add it.")
    values = np.empty((len(records), len(header)))
    for index, (line, cells) in enumerate(records):
        for column, cell in enumerate(cells):
            value = number_in(cell)
            if value is None:
                raise InputError(
                    f"{path}, line {line}: {header[column]} = {cell!r} (expected a number in mm)."
                )
            values[index, column] = value
    return dict(zip(header, values.T, strict=True)), [line for line, _ in records]


def _check_order(path: Path, dots: dict, lines: list[int]) -> None:
    height = dots["height_mm"]
    if len(height) < FEWEST_DOTS:
        raise InputError(f"{path}: {len(height)} dots (expected {FEWEST_DOTS} or more).")
    for index in np.flatnonzero(np.diff(height) <= 0)[:1]:
        raise InputError(
            f"{path}, line {lines[index + 1]}: height_mm = {height[index + 1]:g} after "
            f"{height[index]:g} (expected heights that rise from the impact face). Sort the dots; "
            "where the outline folds back, keep the largest radius."
        )
    for name in ("radius_mm", "radius_sd_mm"):
        for index in np.flatnonzero(dots.get(name, np.ones(1)) <= 0)[:1]:
            raise InputError(
                f"{path}, line {lines[index]}: {name} = {dots[name][index]:g} (expected above 0)."
            )


def _check_size(path: Path, dots: dict, lines: list[int], row: dict) -> None:
    """Numbers that no impact can give are in another unit, or are diameters."""
    height, radius = dots["height_mm"], dots["radius_mm"]
    first_radius, first_length = row["initial_diameter_mm"] / 2, row["initial_length_mm"]
    tallest = row.get("final_length_mm", first_length)
    tallest = min(first_length, tallest + 5 * row.get("final_length_mm_sd", 0)) * TALLEST
    if height[0] < 0 or height[-1] > tallest or height[-1] < LOWEST * first_length:
        raise InputError(
            f"{path}, line {lines[-1]}: heights from {height[0]:g} to {height[-1]:g} (expected mm "
            f"from the impact face up to the final length of {row['id']}, at most {tallest:.4g})."
        )
    if radius.min() > 1.7 * first_radius and radius[-1] > 1.9 * first_radius:
        raise InputError(
            f"{path}: radius_mm = {radius[-1]:g} at the rear of {row['id']}, whose initial radius "
            f"is {first_radius:g}. Are these diameters? Halve them."
        )
    for index in range(len(radius)):
        if not NARROWEST * first_radius <= radius[index] <= WIDEST * first_radius:
            raise InputError(
                f"{path}, line {lines[index]}: radius_mm = {radius[index]:g} (expected about the "
                f"initial radius of {row['id']}, {first_radius:g} mm). Is it in mm?"
            )
