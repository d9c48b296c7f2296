"""Writes a list of candidates as diagnoses get it, with the signatures that belong to it.

/usr/bin/python3 tests/discovery/candidate_lists.py --study tests/discovery/study --list list1 \\
    --signatures signatures.h5 --finer signatures_finer.h5 --out lists/list1/metal3

A list lacks one effect, or has constants that double some: rows of other candidates are left
out of its signatures, so that nothing in its folder tells of them.
"""

import argparse
import json
import os
from pathlib import Path

import h5py
import numpy as np
from hide import read_candidates
from make_tables import is_listed, plan_of
from plan import list_names


def kept_rows(inputs: np.ndarray, names: list[str], dropped: list[dict]) -> np.ndarray:
    """Runs in which every dropped candidate is absent."""
    away = [inputs[:, names.index(item["name"])] != item["base"] for item in dropped]
    return ~np.any(away, axis=0) if away else np.ones(len(inputs), dtype=bool)


def write_part(source: Path, target: Path, dropped: list[dict]) -> None:
    """The database without the columns of the dropped candidates and the runs that had them."""
    partial = target.with_name(target.name + ".tmp")
    with h5py.File(source) as old, h5py.File(partial, "w") as new:
        names = list(old["inputs"].attrs["names"])
        rows = kept_rows(old["inputs"][:], names, dropped)
        gone = {item["name"] for item in dropped}
        columns = [index for index, name in enumerate(names) if name not in gone]
        new.attrs.update(old.attrs)
        for key, data in old.items():
            values = data[:][rows]
            values = values[:, columns] if key == "inputs" else values
            new.create_dataset(key, data=values, dtype=data.dtype, track_times=False)
            if key != "inputs":
                new[key].attrs.update(data.attrs)
        text = h5py.string_dtype(encoding="utf-8")
        new["inputs"].attrs.create("names", [names[c] for c in columns], dtype=text)
    os.replace(partial, target)


def write_candidates(path: Path, listed: list[dict]) -> None:
    """As `calibrate diagnose` reads them; `typical` was for the signatures' design."""
    told = [{key: item[key] for key in item if key != "typical"} for item in listed]
    path.write_text(json.dumps({"candidates": told}, indent=1) + "\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("study", "signatures", "finer", "out"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--list", required=True)
    options = parser.parse_args()
    candidates = read_candidates(options.study)
    which = {name: key for key, name in list_names(plan_of(candidates)).items()}[options.list]
    listed = [item for item in candidates if is_listed(item["name"], which)]
    dropped = [item for item in candidates if item not in listed]
    options.out.mkdir(parents=True, exist_ok=True)
    write_candidates(options.out / "candidates.json", listed)
    write_part(options.signatures, options.out / "signatures.h5", dropped)
    write_part(options.finer, options.out / "signatures_finer.h5", dropped)


if __name__ == "__main__":
    main()
