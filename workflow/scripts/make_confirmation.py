"""Writes confirmation.json: the solver's own sizes at the posterior maximum against the table.

Whitened as in comparison.json, with the same covariance C = L L^T of each shot: errors of
measurement and velocity, and the network's. The last stays in although no network is asked
here, so that this misfit and the network's differ by the prediction alone.
"""

import math
from pathlib import Path

import h5py
import numpy as np

from json_file import read_json, write_json
from make_confirmation_design import shots_in_use
from measurements import read_measurements
from stage_log import logged_to

USES = ("calibrate", "validate")


def confirmation(comparison: dict, runs: dict[str, dict]) -> dict:
    """`runs`: {"sizes": {name: mm}, "reason": why it did not stop} by the shot's id."""
    shots = []
    for shot in comparison["shots"]:
        run = runs[shot["id"]]
        entry = {"id": shot["id"], "use": shot["use"], "sizes": _cells(shot, run)}
        if run["reason"]:
            entry["reason"] = run["reason"]
        shots.append(entry)
    misfit = {use: _misfit([shot for shot in shots if shot["use"] == use]) for use in USES}
    return {"schema": "taylorcal/confirmation/1", "shots": shots, "misfit": misfit}


def _cells(shot: dict, run: dict) -> list[dict]:
    """One entry a size that the solver gives; a run that did not stop has none."""
    kept, cells = [], []
    for index, cell in enumerate(shot["sizes"]):
        solver = run["sizes"].get(cell["size"], math.nan)
        if run["reason"] or not math.isfinite(solver):
            continue
        kept.append(index)
        cells.append(
            {
                "size": cell["size"],
                "measured": cell["measured"],
                "solver": solver,
                "network": cell["predicted"],
            }
        )
    if not cells:
        return []
    covariance = np.array(shot["covariance_mm2"])[np.ix_(kept, kept)]
    residual = np.array([cell["measured"] - cell["solver"] for cell in cells])
    whitened = np.linalg.solve(np.linalg.cholesky(covariance), residual)
    return [{**cell, "whitened": float(z)} for cell, z in zip(cells, whitened, strict=True)]


def _misfit(shots: list[dict]) -> dict:
    values = [cell["whitened"] for shot in shots for cell in shot["sizes"]]
    chi2 = sum(value**2 for value in values)
    rms = math.sqrt(chi2 / len(values)) if values else None
    failed = [shot["id"] for shot in shots if "reason" in shot]
    return {"n": len(values), "chi2": chi2, "whitened_rms": rms, "not_stopped": failed}


def read_runs(path: Path, ids: list[str]) -> dict[str, dict]:
    """The runs of a confirmation design by id; `ids` in the order of its shots."""
    with h5py.File(path) as file:
        names = [str(name) for name in file["outputs"].attrs["names"]]
        reasons = file["reason"].asstr()[:]
        numbers, sizes = file["run_id"][:], file["outputs"][:]
        status = file["status"][:]
    return {
        ids[number]: {
            "sizes": dict(zip(names, map(float, sizes[row]), strict=True)),
            "reason": str(reasons[row]) or "it did not stop" if status[row] else "",
        }
        for row, number in enumerate(numbers)
    }


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        shots = shots_in_use(read_measurements(Path(snakemake.input.measurements)))  # noqa: F821
        runs = read_runs(Path(snakemake.input.runs), [shot["id"] for shot in shots])  # noqa: F821
        found = confirmation(read_json(snakemake.input.comparison), runs)  # noqa: F821
        write_json(snakemake.output[0], found)  # noqa: F821
