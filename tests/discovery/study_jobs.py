"""Which files the jobs that make the discovery study read."""

HOME = "results/discovery/study"
# The first 169 points a shape of the design's 500: already there the network is within 0.2 % of
# the length, and the face's rest is mostly the coarse solver's own scatter.
DATABASE_ROWS = "0:507"


def design_of(wildcards) -> str:
    part = "" if wildcards.part == "database" else f"{wildcards.part}_"
    return f"{HOME}/{part}design.h5"


def rows_of(wildcards) -> str:
    return DATABASE_ROWS if wildcards.part == "database" else ":"
