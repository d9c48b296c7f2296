"""Writes the configuration of one stage, cut from the study, as JSON."""

import json
from pathlib import Path

if __name__ == "__main__":
    text = json.dumps(snakemake.params.settings, indent=2) + "\n"  # noqa: F821
    Path(snakemake.output[0]).write_text(text)  # noqa: F821
