"""The stages whose cost the report tells, in the order in which they run."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Stage:
    """`result`: the one that its cost is told with, by the names of the report's inputs."""

    words: str
    result: str | None = None


STAGES = {
    "design": Stage("design"),
    "runs": Stage("solver runs", "database"),
    "further_runs": Stage("further solver runs", "database"),
    "merge": Stage("merging", "database"),
    "better_runs": Stage("runs of the better solver", "emulator"),
    "first_train": Stage("first training", "emulator"),
    "first_sample": Stage("first sampling", "emulator"),
    "near_runs": Stage("runs near its posterior", "emulator"),
    "train": Stage("training", "emulator"),
    "sample": Stage("sampling", "posterior"),
    "compare": Stage("comparing", "comparison"),
}
