"""Writes a copy of a database with the outlines' scores as further outputs."""

from pathlib import Path

from outlines.basis import read_basis
from outlines.database import write_scored_database
from stage_log import logged_to

if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        write_scored_database(
            Path(snakemake.input.database),  # noqa: F821
            read_basis(Path(snakemake.input.basis)),  # noqa: F821
            Path(snakemake.output[0]),  # noqa: F821
        )
