"""What the workflow computes, and which files a job reads: tables, variants and lists by name."""

import json
from pathlib import Path

from make_tables import plan_of
from plan import ALL, SETS, Variant, list_names, metal_name

STUDY = Path("tests/discovery/study")
HOME = "results/discovery"
BATCH = 20  # tables that one refit job takes

CANDIDATES = json.loads((STUDY / "candidates.json").read_text())["candidates"]
TABLES = {table.id: table for table in plan_of(CANDIDATES)}
VARIANTS = {table.variant.name: table.variant for table in TABLES.values()}
LISTS = list_names(list(TABLES.values()))
METALS = {metal_name(index): index for index in range(SETS)}
BATCHES = range(-(-len(TABLES) // BATCH))


def study_files(*names: str) -> list[str]:
    return [str(STUDY / name) for name in names]


def hide_arguments(wildcards) -> str:
    """Command line of `hide.py` for a variant."""
    variant = VARIANTS[wildcards.variant]
    words = [f"--set {variant.shot_set}"]
    words += [f"--signatures {pairs_of(variant)}"] if variant.effects else []
    words += [f"--effects {' '.join(variant.effects)}"] if variant.effects else []
    words += [f"--strength {variant.strength}"] if variant.strength else []
    words += [f"--material {variant.material}"] if variant.material else []
    return " ".join(words)


def pairs_of(variant: Variant) -> str:
    """Paired runs of the metal that the variant is made of."""
    return f"{HOME}/signatures/{metal_name(variant.shot_set)}/signatures.h5"


def hide_inputs(wildcards) -> list[str]:
    """Amplitudes are scaled by the metal's signatures."""
    variant = VARIANTS[wildcards.variant]
    return [pairs_of(variant)] if variant.effects else []


def runs_of_table(wildcards) -> list[str]:
    """The table's own runs, those of the same shots with nothing hidden, and signatures."""
    variant = TABLES[wildcards.table].variant
    plain = Variant(variant.shot_set)
    names = dict.fromkeys([variant.name, plain.name])
    files = [f"{HOME}/sealed/runs/{name}.h5" for name in names]
    return files if variant == plain else [*files, pairs_of(variant)]


def stand_in(wildcards) -> str:
    """Folder of the table whose posterior the metal's signatures are drawn from."""
    shot_set = METALS[wildcards.metal]
    same = [table for table in TABLES.values() if table.variant.shot_set == shot_set]
    first = next(table for table in same if table.kind == "null" and table.candidates == ALL)
    return f"{HOME}/tables/{first.id}"


def stand_in_files(wildcards) -> dict[str, str]:
    folder = stand_in(wildcards)
    return {
        "measurements": f"{folder}/measurements.csv",
        "posterior": f"{folder}/posterior.h5",
    }


def signature_settings(wildcards) -> str:
    """The study's own fidelity, and the next finer one."""
    return str(STUDY / ("finer.json" if wildcards.part == "signatures_finer" else "solver.json"))


def list_of_table(wildcards) -> dict[str, str]:
    """The candidates that the table's diagnosis gets, and their signatures."""
    table = TABLES[wildcards.table]
    folder = f"{HOME}/lists/{LISTS[table.candidates]}/{metal_name(table.variant.shot_set)}"
    return {
        "candidates": f"{folder}/candidates.json",
        "signatures": f"{folder}/signatures.h5",
        "finer": f"{folder}/signatures_finer.h5",
    }


def tables_of_batch(wildcards) -> list[str]:
    return list(TABLES)[int(wildcards.batch) * BATCH :][:BATCH]


def diagnoses_of_batch(wildcards) -> list[str]:
    return [f"{HOME}/tables/{table}/diagnosis.json" for table in tables_of_batch(wildcards)]


def refit_arguments(wildcards) -> list[str]:
    """Tables of a batch with their metal's paired runs."""
    return [f"{name}={pairs_of(TABLES[name].variant)}" for name in tables_of_batch(wildcards)]
