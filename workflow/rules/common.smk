# What the rules share: the study's settings stage by stage, and names of files.
import sys
from functools import cache
from pathlib import Path

from snakemake.exceptions import WorkflowError
from snakemake.utils import min_version

sys.path.insert(0, str(Path(workflow.basedir) / "workflow" / "scripts"))

from input_errors import InputError
from measurements import check_against_study, read_measurements
from outlines.table import check_outlines
from study import EXPERIMENTS, STAGE_SETTINGS, design_settings, load_study, uses_outlines

min_version("7.21")


wildcard_constraints:
    study="[A-Za-z0-9_]+",
    chunk="[0-9]+",
    stage="|".join(STAGE_SETTINGS),


@cache
def study_of(name):
    """The study and its table, both checked, whichever stage asks first."""
    try:
        study = load_study(name)
        table = EXPERIMENTS / name / study["measurements"]
        rows = read_measurements(table)
        check_against_study(rows, study, table)
        if uses_outlines(study):
            check_outlines(rows, study, table)
    except InputError as error:
        raise WorkflowError(str(error))
    return study


def stage_settings(wildcards):
    return STAGE_SETTINGS[wildcards.stage](study_of(wildcards.study))


def design_settings_of(wildcards):
    return design_settings(study_of(wildcards.study))


def measurements_of(wildcards):
    study = study_of(wildcards.study)
    return str(EXPERIMENTS / wildcards.study / study["measurements"])


def fitted_table_of(wildcards):
    """The table that is fitted: with the outlines' scores if the study compares them."""
    if uses_outlines(study_of(wildcards.study)):
        return f"results/{wildcards.study}/outlines/measurements.csv"
    return measurements_of(wildcards)


def training_database_of(wildcards):
    """The runs that the network learns: with the outlines' scores if the study compares them."""
    folder = "outlines/" if uses_outlines(study_of(wildcards.study)) else ""
    return f"results/{wildcards.study}/{folder}database.h5"


def outlines_of(wildcards):
    """The files of the measured outlines that are compared."""
    table = Path(measurements_of(wildcards))
    rows = [row for row in read_measurements(table) if row["use"] != "ignore"]
    return [str(table.parent / row["outline"]) for row in rows if row["outline"]]


def outline_errors_of(wildcards):
    return study_of(wildcards.study)["outlines"]


def outline_results_of(wildcards):
    """What the report shows of the outlines, if the study compares them."""
    if not uses_outlines(study_of(wildcards.study)):
        return {}
    names = {"outline_basis": "basis", "outline_scores": "scores"}
    folder = f"results/{wildcards.study}/outlines"
    return {key: f"{folder}/{name}.json" for key, name in names.items()}


def rows_of_chunk(wildcards):
    """First row and the row after the last one, as `solver batch --rows` wants them."""
    database = study_of(wildcards.study)["database"]
    runs, chunks, chunk = database["runs"], database["chunks"], int(wildcards.chunk)
    return f"{chunk * runs // chunks}:{(chunk + 1) * runs // chunks}"


def chunks_of(wildcards):
    chunks = study_of(wildcards.study)["database"]["chunks"]
    return expand("results/{study}/chunks/{chunk}.h5", chunk=range(chunks), study=wildcards.study)



def benchmarks_of(wildcards):
    """The report tells what the stages cost; it does not depend on it."""
    return f"results/{wildcards.study}/benchmarks"


study_of(config["study"])
