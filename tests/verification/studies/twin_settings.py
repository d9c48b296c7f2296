"""train.json of the twins' network, which has no better runs to hold back."""

import sys
from pathlib import Path

sys.path.append("workflow/scripts")

from json_file import read_json, write_json  # noqa: E402

HELD_BACK = 0.15  # of the coarse runs

if __name__ == "__main__":
    settings = read_json(Path(snakemake.input[0]))  # noqa: F821
    write_json(snakemake.output[0], {**settings, "validation_fraction": HELD_BACK})  # noqa: F821
