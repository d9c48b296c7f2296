"""Writes plate.json and runs `solver plate` on it."""

import json
import subprocess
from pathlib import Path


def main(document, settings, velocity, log):
    Path(settings).write_text(json.dumps(document, indent=2))
    with open(log, "w") as file:
        command = ["build/bin/solver", "plate", settings, "--out", velocity]
        subprocess.run(command, stdout=file, stderr=file, check=True)


if __name__ == "__main__":
    main(snakemake.params.document, *snakemake.output, snakemake.log[0])  # noqa: F821
