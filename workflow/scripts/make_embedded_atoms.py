"""Writes the potential that the isotherms use."""

from pathlib import Path

from equation_of_state.embedded_atoms import write_eam
from stage_log import logged_to

if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        write_eam(
            Path(snakemake.output[0]),  # noqa: F821
            Path(snakemake.input[0]),  # noqa: F821
            snakemake.params.element,  # noqa: F821
        )
