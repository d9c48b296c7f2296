"""What few 3D runs buy a network of many axisymmetric ones: its error on 3D runs that no training
saw, against the processor time of the runs that it learnt from.
"""

from pathlib import Path

from draw_three_dimensions import HELD_OUT
from two_solvers import compare, draw, outputs_of, solver_scatter

AXISYMMETRIC = [0, 600, 4800]  # runs learnt from
THREE_DIMENSIONAL = [0, 44, 88, 176, 352]
LABELS = {0: "3D runs alone", 600: "+ 600 axisymmetric runs", 4800: "+ 4800 axisymmetric runs"}
NAMES = {"cheaper_runs": "axisymmetric_runs", "better_runs": "three_dimensional_runs"}

if __name__ == "__main__":
    given, made = snakemake.input, snakemake.output  # noqa: F821
    files = (given.database, given.runs, given.train)
    folder = Path(made.table).with_suffix("")
    found = compare(files, folder, AXISYMMETRIC, THREE_DIMENSIONAL, HELD_OUT)
    # All its runs harden, so that the columns of those that do say nothing more.
    kept = [name for name in found if not name.startswith("hardening_")]
    found[kept].rename(columns=NAMES).round(4).to_csv(made.table, index=False)
    scatter = solver_scatter(given.runs, given.repeats, outputs_of(given.train))
    scatter[scatter["runs"] == "all"].round(4).to_csv(made.scatter, index=False)
    draw(found, scatter, made.figure, LABELS, "3D")
