"""Writes ladder.json: a study's revisions side by side, the base first.

Whitened misfits and groups are those of each revision's comparison, so each is whitened
with the error of its own network. `confirmed` holds the solver's own misfit at the optimum.
"""

import json
import math
from dataclasses import dataclass

import h5py
import numpy as np

from json_file import read_json, write_json
from revisions import revision_ids
from stage_log import logged_to

SUMMARY = ("name", "mean", "sd", "lower95", "median", "upper95")
MISFIT = ("n", "chi2", "whitened_rms")


@dataclass
class Revision:
    """What the stages found for one revision."""

    comparison: dict
    confirmation: dict
    log_evidence: float | None  # None: the paper's likelihood has no evidence
    log_evidence_sd: float | None
    runs: int  # rows of its database
    draws: dict[str, np.ndarray]  # by parameter; densities as natural logarithms


def ladder(effects: list[str], revisions: list[Revision]) -> dict:
    """`revisions`: of the base and of each prefix of `effects`."""
    rungs = []
    for count, identity in enumerate(revision_ids(effects)):
        previous = revisions[count - 1] if count else None
        rungs.append({"id": identity, "effects": effects[:count], **_rung(revisions[count])})
        rungs[-1]["new_runs"] = revisions[count].runs - (previous.runs if previous else 0)
        rungs[-1]["shift_sd"] = _shifts(revisions[count], previous) if previous else {}
    return {"schema": "taylorcal/ladder/1", "revisions": rungs}


def _rung(revision: Revision) -> dict:
    comparison = revision.comparison
    return {
        "misfit": {
            use: {key: _finite(values[key]) for key in MISFIT}
            for use, values in comparison["misfit"].items()
        },
        "confirmed": revision.confirmation["misfit"],
        "groups": comparison["groups"],
        "log_evidence": revision.log_evidence,
        "log_evidence_sd": revision.log_evidence_sd,
        "parameters": [{key: entry[key] for key in SUMMARY} for entry in comparison["parameters"]],
    }


def _shifts(revision: Revision, previous: Revision) -> dict[str, float]:
    """How far each parameter's mean moved, in its standard deviation before."""
    return {
        name: float((draws.mean() - before.mean()) / before.std())
        for name, draws in revision.draws.items()
        if (before := previous.draws.get(name)) is not None and before.std() > 0
    }


def _finite(value: float) -> float | None:
    return value if value is not None and math.isfinite(value) else None


def read_revision(comparison: str, confirmation: str, posterior: str, database: str) -> Revision:
    with h5py.File(posterior) as file:
        evidence = [_finite(float(file.attrs[key])) for key in ("ln_evidence", "ln_evidence_sd")]
        names = [str(name) for name in file["draws"].attrs["names"]]
        columns = file["draws"][:]
        configuration = json.loads(file.attrs["configuration"])
    with h5py.File(database) as file:
        runs = len(file["run_id"])
    logarithmic = {
        parameter["name"]
        for parameter in configuration["parameters"]
        if parameter.get("prior") == "log_uniform"
    }
    draws = {
        name: np.log(columns[:, index])
        if name.partition("[")[0] in logarithmic
        else columns[:, index]
        for index, name in enumerate(names)
    }
    return Revision(read_json(comparison), read_json(confirmation), *evidence, runs, draws)


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        files = zip(
            snakemake.input.comparisons,  # noqa: F821
            snakemake.input.confirmations,  # noqa: F821
            snakemake.input.posteriors,  # noqa: F821
            snakemake.input.databases,  # noqa: F821
            strict=True,
        )
        revisions = [read_revision(*each) for each in files]
        found = ladder(snakemake.params.effects, revisions)  # noqa: F821
        write_json(snakemake.output[0], found)  # noqa: F821
