"""What the workflow computes, and which files a job reads: tables, variants and lists by name."""

import json
from pathlib import Path

from make_tables import hideable, twins_of
from plan import Variant, list_names, plan

STUDY = Path("tests/discovery/study")
HOME = "results/discovery"
BATCH = 20  # tables that one refit job takes

CANDIDATES = json.loads((STUDY / "candidates.json").read_text())["candidates"]
TABLES = {table.id: table for table in plan(hideable(CANDIDATES), twins_of(CANDIDATES))}
VARIANTS = {table.variant.name: table.variant for table in TABLES.values()}
LISTS = list_names(list(TABLES.values()))
BATCHES = range(-(-len(TABLES) // BATCH))


def study_files(*names: str) -> list[str]:
    return [str(STUDY / name) for name in names]


def hide_arguments(wildcards) -> str:
    """Command line of `hide.py` for a variant."""
    variant = VARIANTS[wildcards.variant]
    words = [f"--set {variant.shot_set}"]
    words += [f"--effects {' '.join(variant.effects)}"] if variant.effects else []
    words += [f"--strength {variant.strength}"] if variant.strength else []
    words += [f"--material {variant.material}"] if variant.material else []
    return " ".join(words)


def hide_inputs(wildcards) -> list[str]:
    """Amplitudes are scaled by the study's network and signatures."""
    files = study_files("candidates.json", "emulator.json", "signatures.h5")
    return files if VARIANTS[wildcards.variant].effects else []


def runs_of_table(wildcards) -> list[str]:
    """The table's own runs, and those of the same shots with nothing hidden."""
    variant = TABLES[wildcards.table].variant
    names = dict.fromkeys([variant.name, Variant(variant.shot_set).name])
    return [f"{HOME}/sealed/runs/{name}.h5" for name in names]


def list_of_table(wildcards) -> dict[str, str]:
    """The candidates that the table's diagnosis gets, and their signatures."""
    folder = f"{HOME}/lists/{LISTS[TABLES[wildcards.table].candidates]}"
    return {
        "candidates": f"{folder}/candidates.json",
        "signatures": f"{folder}/signatures.h5",
        "finer": f"{folder}/signatures_finer.h5",
    }


def tables_of_batch(wildcards) -> list[str]:
    return list(TABLES)[int(wildcards.batch) * BATCH :][:BATCH]


def diagnoses_of_batch(wildcards) -> list[str]:
    return [f"{HOME}/tables/{table}/diagnosis.json" for table in tables_of_batch(wildcards)]
