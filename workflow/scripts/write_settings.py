"""Writes the configuration of one stage, cut from the study, as JSON."""

import json
from pathlib import Path

from stage_log import logged_to

if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        text = json.dumps(snakemake.params.settings, indent=2) + "\n"  # noqa: F821
        Path(snakemake.output[0]).write_text(text)  # noqa: F821
