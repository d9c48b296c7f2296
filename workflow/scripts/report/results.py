"""Loads what the stages wrote into one object for the page."""

import csv
import json
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from database_costs import read_costs
from job_log import job_record
from json_file import read_json
from measurements import read_measurements
from outlines.basis import OutlineBasis, read_basis
from report.stages import STAGES


@dataclass
class Posterior:
    names: list[str]
    draws: np.ndarray
    maps_1d: dict[str, tuple]  # name: (edges, density)
    maps_2d: dict[tuple[str, str], tuple]  # names: (x_edges, y_edges, density)
    maxima: np.ndarray
    maxima_log_density: np.ndarray
    maxima_share: np.ndarray
    attributes: dict


@dataclass
class Database:
    status: np.ndarray  # 0 stopped, 1 not stopped, 2 failed, 3 over its CPU limit
    reasons: list[str]
    steps: np.ndarray
    descriptors: dict[str, np.ndarray]
    cpu_s: list[float]
    attributes: dict


@dataclass
class Outlines:
    """Of a study that compares measured outlines."""

    table: Path  # beside which the outlines lie
    basis: OutlineBasis
    projections: dict  # by id; see outlines.table.projection_document


@dataclass
class Results:
    settings: dict
    rows: list[dict]
    comparison: dict
    emulator: dict
    posterior: Posterior
    database: Database
    stage_costs: list[dict]  # {"stage", "jobs", "hosts", "wall_s", "cpu_s", "memory_MB"}
    outlines: Outlines | None = None

    @property
    def lots(self) -> list[str]:
        return list(dict.fromkeys(row["lot"] for row in self.rows))

    @property
    def used_rows(self) -> list[dict]:
        return [row for row in self.rows if row["use"] != "ignore"]


def load_results(inputs: dict[str, Path], benchmarks: Path) -> Results:
    return Results(
        settings=read_json(inputs["settings"]),
        rows=read_measurements(inputs["measurements"]),
        comparison=read_json(inputs["comparison"]),
        emulator=read_json(inputs["emulator"]),
        posterior=_posterior(inputs["posterior"]),
        database=_database(inputs["database"]),
        stage_costs=_stage_costs(benchmarks),
        outlines=_outlines(inputs),
    )


def _outlines(inputs: dict[str, Path]) -> Outlines | None:
    if "outline_basis" not in inputs:
        return None
    basis, projections = read_basis(inputs["outline_basis"]), read_json(inputs["outline_scores"])
    return Outlines(inputs["measurements"], basis, projections)


def _texts(values) -> list[str]:
    return [value.decode() if isinstance(value, bytes) else str(value) for value in values]


def _attributes(file: h5py.File) -> dict:
    """Attributes of a file; those that hold JSON as what they hold."""
    found = {}
    for name, value in file.attrs.items():
        if isinstance(value, (str, bytes)):
            text = _texts([value])[0]
            found[name] = json.loads(text) if text.startswith("{") else text
        else:
            found[name] = float(value)
    return found


def _posterior(path: Path) -> Posterior:
    with h5py.File(path) as file:
        maps_1d = {
            name: (map_["edges"][:], map_["density"][:])
            for name, map_ in file.get("maps_1d", {}).items()
        }
        maps_2d = {
            tuple(name.split("__", 1)): (map_["x_edges"][:], map_["y_edges"][:], map_["density"][:])
            for name, map_ in file.get("maps_2d", {}).items()
        }
        return Posterior(
            names=_texts(file["draws"].attrs["names"]),
            draws=file["draws"][:],
            maps_1d=maps_1d,
            maps_2d=maps_2d,
            maxima=file["maxima"][:],
            maxima_log_density=file["maxima_log_density"][:],
            maxima_share=file["maxima_share"][:],
            attributes=_attributes(file),
        )


def _database(path: Path) -> Database:
    with h5py.File(path) as file:
        names = _texts(file["descriptors"].attrs["names"])
        columns = file["descriptors"][:]
        found = {
            "status": file["status"][:],
            "reasons": _texts(file["reason"][:]),
            "steps": file["steps"][:],
            "descriptors": {name: columns[:, index] for index, name in enumerate(names)},
            "attributes": _attributes(file),
        }
    return Database(**found, cpu_s=_run_costs(path))


def _run_costs(database: Path) -> list[float]:
    """CPU seconds lie beside the database, whose bytes must not depend on them."""
    if not Path(f"{database}.cost.csv").exists():
        return []
    return list(read_costs(database).values())


def _stage_costs(folder: Path) -> list[dict]:
    """Of each stage what its jobs cost, and on which machines, from their logs and benchmarks."""
    costs = []
    for stage in STAGES:
        records, jobs = [], []
        for path in sorted([*folder.glob(f"{stage}.tsv"), *folder.glob(f"{stage}_*.tsv")]):
            jobs.append(job_record(folder.parent / "logs" / f"{path.stem}.log"))
            with path.open(newline="") as file:
                records += list(csv.DictReader(file, delimiter="\t"))
        if records:
            costs.append(
                {
                    "stage": stage,
                    "jobs": len(records),
                    "hosts": sorted({job.host for job in jobs if job.host}),
                    "wall_s": sum(job.wall_s or 0 for job in jobs),
                    "cpu_s": sum(job.cpu_s or 0 for job in jobs),
                    "memory_MB": max(_number(record["max_rss"]) for record in records),
                }
            )
    return costs


def _number(text: str) -> float:
    """Snakemake writes NA or - for jobs too short to be sampled."""
    return float(text) if text not in ("NA", "-", "") else 0.0
