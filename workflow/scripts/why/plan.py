"""The jobs that a dry run of Snakemake plans, with its own reasons."""

import json
import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from input_errors import InputError
from revisions import split_home
from why.log_jobs import MARK

HANDLER = Path(__file__).resolve().parent / "log_jobs.py"

# Snakemake 7's wording of what it found, and of what each kind is called here.
KINDS = {
    "Missing output files": "missing",
    "Incomplete output files": "interrupted",
    "Updated input files": "newer",
    "Input files updated by another job": "follows",
    "Set of input files has changed since last execution": "files",
    "Code has changed since last execution": "code",
    "Params have changed since last execution": "settings",
}


@dataclass
class Job:
    """A planned job. `reasons`: files by kind (a value of KINDS), or by Snakemake's own words
    where those are not known here. `rows`: number of rows of the design that it computes.
    """

    rule: str
    wildcards: dict[str, str]
    outputs: list[str]
    reasons: dict[str, list[str]] = field(default_factory=dict)
    rows: int | None = None

    @property
    def revision(self) -> str:
        """The id of the revision, empty for the base and for what all revisions share."""
        return "+".join(split_home(self.wildcards.get("study", ""))[1])


def planned_jobs(command: list[str]) -> list[Job]:
    """Runs the command, which ends in --dry-run, and returns its jobs in order, `all` left out."""
    run = subprocess.run(
        [*command, "--log-handler-script", str(HANDLER)], capture_output=True, text=True
    )
    if run.returncode:
        raise InputError(f"snakemake cannot plan the study:\n{run.stdout}{run.stderr}".strip())
    jobs: list[Job] = []
    for line in run.stdout.splitlines():
        if not line.startswith(MARK):
            continue
        told = json.loads(line.removeprefix(MARK))
        if "shell" in told:
            rows = re.search(r"--rows (\d+):(\d+)", told["shell"])
            jobs[-1].rows = int(rows[2]) - int(rows[1]) if rows else None
        else:
            reasons = parsed_reasons(told["reason"])
            jobs.append(Job(told["name"], told["wildcards"], told["output"], reasons))
    return [job for job in jobs if job.rule != "all"]


def parsed_reasons(text: str) -> dict[str, list[str]]:
    """The files of each kind of reason in Snakemake's text; no file is a kind of its own."""
    found = {}
    for part in filter(None, text.split("; ")):
        kind, _, files = part.partition(": ")
        found[KINDS.get(kind, part)] = sorted(filter(None, files.split(", ")))
    return found
