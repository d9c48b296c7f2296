"""Writes the design of the paired runs, and the settings that it is computed with."""

import json
from pathlib import Path

from identifiability_runs import FIDELITY, listed_effects, paired_design

from make_design import write_design


def main(design_path, settings_path):
    write_design(Path(design_path), paired_design(listed_effects()))
    settings = {"geometry": "axisymmetric", "fidelity": FIDELITY}
    Path(settings_path).write_text(json.dumps(settings))


if __name__ == "__main__":
    main(*snakemake.output)  # noqa: F821
