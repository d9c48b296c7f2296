"""Writes the configuration of one stage, cut from the study, as JSON."""

import json

from atomic_file import write_text
from stage_log import logged_to

if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        text = json.dumps(snakemake.params.settings, indent=2) + "\n"  # noqa: F821
        write_text(snakemake.output[0], text)  # noqa: F821
