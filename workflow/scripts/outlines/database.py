"""Outlines of a database, and the database with their scores as further outputs."""

from pathlib import Path

import h5py
import numpy as np

from atomic_file import written_whole
from input_errors import InputError
from outlines.basis import OutlineBasis
from size_kinds import OUTLINE_SCORES

STOPPED = 0


def read_outlines(path: Path) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Fractions of the length, and the outlines of each shape's runs that stopped."""
    with h5py.File(path) as file:
        radii, fractions = outline_radii(file, path)
        shape, status = file["shape"].asstr()[:], file["status"][:]
    usable = (status == STOPPED) & np.isfinite(radii).all(axis=1)
    return fractions, {str(name): radii[usable & (shape == name)] for name in dict.fromkeys(shape)}


def outline_radii(file: h5py.File, path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Radii [runs x heights] over the initial radius, and fractions [heights]."""
    if "outline_radius" not in file:
        raise InputError(
            f"{path}: has no outlines (made by an older solver). Delete it and its chunks, and "
            "run again."
        )
    return file["outline_radius"][:], file["outline_radius"].attrs["fractions"][:]


def score_table(path: Path, basis: OutlineBasis) -> np.ndarray:
    """Scores [runs x COMPONENTS] in mm of radius, NaN where a run has no outline."""
    with h5py.File(path) as file:
        radii, fractions = outline_radii(file, path)
        names = list(file["inputs"].attrs["names"])
        diameter_mm = file["inputs"][:, names.index("initial_diameter_mm")]
        shapes = file["shape"].asstr()[:]
    if not np.array_equal(fractions, basis.fractions):
        raise InputError(f"{path}: keeps outlines at other heights than its basis. Make it anew.")
    scores = np.full((len(radii), len(OUTLINE_SCORES)), np.nan)
    for shape in basis.shapes:
        mine = shapes == shape
        scores[mine] = basis.scores(shape, radii[mine])
    return scores * diameter_mm[:, None] / 2


def write_scored_database(source: Path, basis: OutlineBasis, target: Path) -> None:
    """A copy of the database whose outputs have the scores [mm] after the sizes."""
    scores = score_table(source, basis)
    text = h5py.string_dtype(encoding="utf-8")
    with (
        written_whole(target) as partial,
        h5py.File(source) as old,
        h5py.File(partial, "w") as new,
    ):
        for name in old:
            if name != "outputs":
                old.copy(name, new)
        for name, value in old.attrs.items():
            new.attrs[name] = value
        outputs = np.hstack([old["outputs"][:], scores])
        new.create_dataset("outputs", data=outputs, track_times=False)
        names = [*old["outputs"].attrs["names"], *OUTLINE_SCORES]
        new["outputs"].attrs.create("names", names, dtype=text)
