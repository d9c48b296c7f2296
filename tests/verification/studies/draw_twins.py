"""Writes the runs of the twins' shots."""

import sys
from pathlib import Path

import yaml

from twin_tables import joined, twin_designs

sys.path.append("workflow/scripts")

from make_design import write_design  # noqa: E402

if __name__ == "__main__":
    study = yaml.safe_load(Path(snakemake.input.study).read_text())  # noqa: F821
    write_design(Path(snakemake.output[0]), joined(twin_designs(study["parameters"])))  # noqa: F821
