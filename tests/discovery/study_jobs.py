"""Which files the jobs that make the discovery study read."""

HOME = "results/discovery/study"


def design_of(wildcards) -> str:
    part = "" if wildcards.part == "database" else f"{wildcards.part}_"
    return f"{HOME}/{part}design.h5"
