"""Writes the table of shots with the scores of its measured outlines, and how well they fit."""

from pathlib import Path

from json_file import write_json
from outlines.basis import read_basis
from outlines.table import projection_document, projections, write_scored_table
from stage_log import logged_to

if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        table = Path(snakemake.input.measurements)  # noqa: F821
        basis = read_basis(Path(snakemake.input.basis))  # noqa: F821
        projected = projections(table, basis, **snakemake.params.errors)  # noqa: F821
        write_scored_table(table, basis, projected, Path(snakemake.output.table))  # noqa: F821
        write_json(snakemake.output.scores, projection_document(projected))  # noqa: F821
