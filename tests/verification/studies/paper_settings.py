"""calibrate.json of the source paper's way of sampling: plain draws from the prior."""

import json
from pathlib import Path


def plain_settings(settings: dict, draws: float) -> dict:
    if draws < 1e5:
        raise ValueError(f"draws = {draws:g} (expected at least 1e5, as in DRAWS=1e7).")
    plain = {"draws_from": "prior", "network_errors": "independent", "draws": int(draws)}
    return {**settings, **plain}


if __name__ == "__main__":
    given = json.loads(Path(snakemake.input[0]).read_text())  # noqa: F821
    made = plain_settings(given, float(snakemake.params.draws))  # noqa: F821
    Path(snakemake.output[0]).write_text(json.dumps(made, indent=1))  # noqa: F821
