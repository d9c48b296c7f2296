# What the rules share about a second round of runs, near the posterior of a first calibration.
from study import near_design_settings


def has_near(wildcards):
    return bool(study_of(wildcards.study)["database"]["near_posterior"])


def has_better(wildcards):
    return bool(study_of(wildcards.study)["database"]["better"])


def database_name(study):
    """Name of the runs that the network learns from, those that correct them left out."""
    database = study["database"]
    joins = database["near_posterior"] and not database["better"] and not study["revision"]
    return "with_near" if joins else "database"


def database_of(wildcards):
    return with_scores(database_name(study_of(wildcards.study)))(wildcards)


def previous_database_of(wildcards):
    """What a revision goes on from; nothing for the base."""
    home = previous_home(wildcards.study)
    return f"results/{home}/{database_name(study_of(home))}.h5" if home else []


def first_better_of(wildcards):
    """The runs that correct the others, before those near the posterior are there."""
    return with_scores("better")(wildcards) if has_better(wildcards) else []


def better_of(wildcards):
    """The runs that correct the others, if the study has some."""
    if has_better(wildcards) and has_near(wildcards):
        return with_scores("with_near")(wildcards)
    return first_better_of(wildcards)


def joined_with_near(wildcards):
    """Runs of the solver that the network answers as, over the ranges and near the posterior. A
    revision takes those of the base, with an amplitude of 0.
    """
    home = previous_home(wildcards.study)
    if home:
        return f"results/{home}/with_near.h5"
    first = "better" if has_better(wildcards) else "database"
    return [f"results/{wildcards.study}/{name}.h5" for name in (first, "near_runs")]


def near_design_settings_of(wildcards):
    return near_design_settings(study_of(wildcards.study))


def near_rows_of(wildcards):
    return f"0:{study_of(wildcards.study)['database']['near_posterior']['runs']}"
