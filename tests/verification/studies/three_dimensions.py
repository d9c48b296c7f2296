"""What few 3D runs buy a network of many axisymmetric ones: its error on 3D runs that no training
saw, against the processor time of the runs that it learnt from.
"""

from pathlib import Path

from two_solvers import compare, draw

AXISYMMETRIC = [0, 4800]  # runs learnt from
THREE_DIMENSIONAL = [0, 88, 176, 352]
LABELS = {0: "3D runs alone", 4800: "+ 4800 axisymmetric runs"}

if __name__ == "__main__":
    given, made = snakemake.input, snakemake.output  # noqa: F821
    folder = Path(made.table).with_suffix("")
    learnt = (AXISYMMETRIC, THREE_DIMENSIONAL)
    found = compare(given.database, given.runs, given.train, folder, *learnt)
    names = {"cheaper_runs": "axisymmetric_runs", "better_runs": "three_dimensional_runs"}
    # All its runs harden, so that the columns of those that do say nothing more.
    kept = [name for name in found if not name.startswith("hardening_")]
    found[kept].rename(columns=names).round(4).to_csv(made.table, index=False)
    draw(found, None, made.figure, LABELS, "3D")
