"""Writes outline_basis.json: principal components of a database's outlines."""

from pathlib import Path

import h5py

from outlines.basis import make_basis, write_basis
from outlines.database import read_outlines
from stage_log import logged_to

if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        database = Path(snakemake.input.database)  # noqa: F821
        with h5py.File(database) as file:
            origin = {"database": str(database), "solver": file.attrs["provenance"]}
        write_basis(
            Path(snakemake.output[0]),  # noqa: F821
            make_basis(*read_outlines(database)),
            origin,
        )
