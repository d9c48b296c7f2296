"""What the runs of a database cost: the table that the solver writes beside it."""

import csv
from pathlib import Path


def read_costs(database: Path) -> dict[int, float]:
    """CPU seconds by number of the run; without runs of which they are not known."""
    with Path(f"{database}.cost.csv").open(newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["cpu_s"]]
    return {int(row["run_id"]): float(row["cpu_s"]) for row in rows}
