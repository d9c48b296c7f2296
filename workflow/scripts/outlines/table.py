"""The table of shots with the scores of its measured outlines, for `calibrate`."""

import csv
from pathlib import Path

from atomic_file import written_whole
from measurements import read_measurements
from outlines.basis import OutlineBasis
from outlines.measured import read_outline
from outlines.projection import Projection, project
from size_kinds import OUTLINE_SCORES
from table_cells import read_cells

# Read off the outline itself: beside its scores they would count the same dots twice.
REPEATED = ["undeformed_length_mm", "diameter_at_0p2L0_mm"]


def check_outlines(rows: list[dict], study: dict, table: Path) -> None:
    """Reads every outline that the study compares, so that a bad one stops it at once."""
    for row in rows:
        if row["outline"] and row["use"] != "ignore":
            read_outline(row, table, study["outlines"]["radius_sd_mm"])


def projections(
    table: Path, basis: OutlineBasis, radius_sd_mm: float, scale_sd: float
) -> dict[str, Projection]:
    """By id, of the shots in use that have an outline and whose shape the basis knows."""
    found = {}
    for row in read_measurements(table):
        if row["outline"] and row["use"] != "ignore" and row["shape"] in basis.shapes:
            measured = read_outline(row, table, radius_sd_mm)
            diameter = row["initial_diameter_mm"]
            found[row["id"]] = project(measured, basis, row["shape"], diameter, scale_sd)
    return found


def write_scored_table(
    table: Path, basis: OutlineBasis, projected: dict[str, Projection], target: Path
) -> None:
    """The table as it stands with columns of scores and errors. A component of which the dots
    tell less than the runs do (its error exceeds the spread of the runs) stays empty."""
    header, records = read_cells(table, "one row a shot")
    rows = [dict(zip(header, cells, strict=True)) for _, cells in records]
    for row in rows:
        projection = projected.get(row["id"].strip())
        spread = basis.shapes[row["shape"].strip()].spread if projection else []
        first_radius = float(row["initial_diameter_mm"]) / 2
        for k, name in enumerate(OUTLINE_SCORES):
            told = projection is not None and projection.sd[k] < spread[k] * first_radius
            row[name] = f"{projection.scores[k]:.6g}" if told else ""
            row[f"{name}_sd"] = f"{projection.sd[k]:.6g}" if told else ""
        if projection is not None:
            row |= {key: "" for key in row if key.removesuffix("_sd") in REPEATED}
    with written_whole(target) as partial, partial.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def projection_document(projected: dict[str, Projection]) -> dict:
    """What the report and a reader want to know of each projection."""
    return {
        name: {
            "scores_mm": projection.scores.tolist(),
            "sd_mm": projection.sd.tolist(),
            "correlation": projection.correlation.tolist(),
            "rms": projection.rms,
        }
        for name, projection in projected.items()
    }
