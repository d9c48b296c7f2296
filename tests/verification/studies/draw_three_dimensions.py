"""Writes 3D runs over the ranges of a study, of metal that hardens."""

import json
import sys
from pathlib import Path

from hardening_metal import HARDENING

sys.path.append("workflow/scripts")

from make_design import design, write_design  # noqa: E402
from study import design_settings  # noqa: E402

LEARNT_FROM = 352
HELD_OUT = 352  # no network of the study learns from them
FIRST_RUN = 200_000_000  # no number is used twice
SOLVER = {"geometry": "3d", "fidelity": "coarse"}


def settings_of(study: dict) -> dict:
    """Of the design: the database's of a study, above the least hardening and immobilization."""
    settings = design_settings(study)
    for name, least in HARDENING.items():
        settings["parameters"][name]["lower"] = least
    return {**settings, "runs": LEARNT_FROM + HELD_OUT, "first_run": FIRST_RUN}


if __name__ == "__main__":
    columns = design(snakemake.params.settings)  # noqa: F821
    write_design(Path(snakemake.output.design), columns)  # noqa: F821
    Path(snakemake.output.settings).write_text(json.dumps(SOLVER))  # noqa: F821
