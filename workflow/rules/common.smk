# What the rules share: the study's settings stage by stage, and names of files.
import sys
from functools import cache
from pathlib import Path

from snakemake.exceptions import WorkflowError
from snakemake.utils import min_version

sys.path.insert(0, str(Path(workflow.basedir) / "workflow" / "scripts"))

from code_digest import code_of
from cost.dry_run import tell_cost_in_dry_run
from effects import check_effects, check_material, solver_list
from input_errors import InputError, did_you_mean
from measurements import check_against_study, read_measurements
from outlines.table import check_outlines
from revisions import HOME, homes_of, previous_home, split_home
from run_cache import use_run_cache
from study import EXPERIMENTS, STAGE_SETTINGS, at_revision, better_design_settings
from study import chunk_count, design_settings, further_design_settings, load_study, new_runs
from study import uses_outlines

min_version("7.21")

for key in set(config) - {"study", "run_cache"}:
    hint = did_you_mean(key, ["study", "run_cache"])
    raise WorkflowError(f"--config {key}={config[key]}: is not a known key. {hint}")
# A name such as 2024 comes as a number, and is refused with the others.
config["study"] = str(config["study"])

use_run_cache(config["run_cache"])


# {study} is a home, so that every rule serves the base and each revision; {name} is the
# study alone.
wildcard_constraints:
    study=HOME,
    name="[A-Za-z0-9_]+",
    chunk="[0-9]+",
    part="[0-9]+",
    stage="|".join(STAGE_SETTINGS),


@cache
def study_of(home):
    """The study at a revision, and its table, checked whichever stage asks first."""
    name, inside = split_home(home)
    try:
        study = load_study(name)
        check_material(study, EXPERIMENTS / name / "study.yaml")
        table = EXPERIMENTS / name / study["measurements"]
        rows = read_measurements(table)
        check_against_study(rows, study, table)
        if uses_outlines(study):
            check_outlines(rows, study, table)
        # A base that nothing was added to does not ask the solver.
        if inside or study["effects"] or study["diagnosis"]["candidates"] != "all":
            known = solver_list("effects")
            asked = {**study, "effects": [*study["effects"], *inside]}
            check_effects(asked, EXPERIMENTS / name / "study.yaml", known)
            study = at_revision(study, [known[effect] for effect in inside])
    except InputError as error:
        raise WorkflowError(str(error))
    return study


def python_script(name):
    """Parameters that stand for a script, which is then "../scripts/{params.script}": one that
    is named outright counts as changed whenever a checkout wrote it anew.
    """
    return {"script": name, "code": code_of(name)}


def logged(command):
    """A rule's command with all that it says in its log, between the machine's name and what
    the job took: see `job_log`.
    """
    return (
        "( echo host $(uname -n); TIMEFORMAT='took %R s, %U s user, %S s system'; time "
        + command
        + " ) > {log} 2>&1"
    )


def homes_of_study(name):
    return homes_of(name, study_of(name)["effects"])


def stage_settings(wildcards):
    return STAGE_SETTINGS[wildcards.stage](study_of(wildcards.study))


def design_settings_of(wildcards):
    return design_settings(study_of(wildcards.study))


def better_design_settings_of(wildcards):
    return better_design_settings(study_of(wildcards.study))


def measurements_of(wildcards):
    study = study_of(wildcards.study)
    return str(EXPERIMENTS / split_home(wildcards.study)[0] / study["measurements"])


def previous(file):
    """The file of the revision before as an input; none for the base."""

    def find(wildcards):
        home = previous_home(wildcards.study)
        return f"results/{home}/{file}" if home else []

    return find


def zero_inputs_of(wildcards):
    return " ".join(f"--zero-input {effect}" for effect in split_home(wildcards.study)[1][-1:])


def fitted_table_of(wildcards):
    """The table that is fitted: with the outlines' scores if the study compares them."""
    if uses_outlines(study_of(wildcards.study)):
        return f"results/{wildcards.study}/outlines/measurements.csv"
    return measurements_of(wildcards)


def with_scores(name):
    """A database of the study: with the outlines' scores if the study compares them."""

    def find(wildcards):
        folder = "outlines/" if uses_outlines(study_of(wildcards.study)) else ""
        return f"results/{wildcards.study}/{folder}{name}.h5"

    return find


def base_outlines_of(wildcards):
    """All revisions use the base's components: their networks go on from each other."""
    return f"results/{split_home(wildcards.study)[0]}/outlines/basis.json"


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
    scores = f"results/{wildcards.study}/outlines/scores.json"
    return {"outline_basis": base_outlines_of(wildcards), "outline_scores": scores}


def rows_of_chunk(wildcards):
    """First row and the row after the last one, as `solver batch --rows` wants them."""
    study = study_of(wildcards.study)
    return share_of_chunk(new_runs(study), chunk_count(study), wildcards)


def share_of_chunk(runs, chunks, wildcards):
    chunk = int(wildcards.chunk)
    return f"{chunk * runs // chunks}:{(chunk + 1) * runs // chunks}"


def chunks_of(wildcards):
    """Those of the home, and in the base the further parts, which revisions take from there."""
    study = study_of(wildcards.study)
    folder = f"results/{wildcards.study}"
    chunks = [f"{folder}/chunks/{chunk}.h5" for chunk in range(chunk_count(study))]
    further = range(0 if study["revision"] else len(study["database"]["further"]))
    return chunks + [f"{folder}/further_chunks/{part}.h5" for part in further]


def further_design_settings_of(wildcards):
    return further_design_settings(study_of(wildcards.study), int(wildcards.part))


def rows_of_part(wildcards):
    return f"0:{study_of(wildcards.study)['database']['further'][int(wildcards.part)]['runs']}"


def better_chunk_count(wildcards):
    database = study_of(wildcards.study)["database"]
    return min(database["chunks"], database["better"]["runs"])


def better_rows_of_chunk(wildcards):
    runs = study_of(wildcards.study)["database"]["better"]["runs"]
    return share_of_chunk(runs, better_chunk_count(wildcards), wildcards)


def better_chunks_of(wildcards):
    """Those of the base: no revision has runs of its own."""
    home = previous_home(wildcards.study)
    if home:
        return f"results/{home}/better.h5"
    name = "results/{study}/better_chunks/{chunk}.h5"
    return expand(name, chunk=range(better_chunk_count(wildcards)), study=wildcards.study)


def best_solver_of(wildcards):
    """The solver that the network answers as."""
    better = "_better" if study_of(wildcards.study)["database"]["better"] else ""
    return f"results/{wildcards.study}/config/solver{better}.json"


def benchmarks_of(wildcards):
    """The report tells what the stages cost; it does not depend on it."""
    return f"results/{wildcards.study}/benchmarks"


tell_cost_in_dry_run(config["study"], study_of(config["study"]), sys.argv[1:])
