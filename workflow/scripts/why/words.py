"""Words the plan of a study for a materials scientist: which stages would run, and why."""

from pathlib import Path

from why.causes import Causes
from why.plan import Job
from why.runs import runs_words

STAGES = {
    "design": "choosing the runs of the database",
    "runs": "runs of the solver for the database",
    "merge": "joining the runs to the database",
    "further_design": "choosing the further runs",
    "further_runs": "further runs of the solver",
    "better_design": "choosing the runs of the better solver",
    "better_runs": "runs of the better solver",
    "better": "joining the runs of the better solver",
    "first_train": "training a first network",
    "first_sample": "sampling a first posterior",
    "near_design": "choosing runs near the first posterior",
    "near_runs": "runs of the solver near the first posterior",
    "with_near": "joining the runs near the first posterior",
    "train": "training the network",
    "sample": "sampling the posterior",
    "compare": "comparing the model with the shots",
    "report": "writing the report",
    "confirmation_design": "choosing the runs that confirm the posterior's maximum",
    "confirmation_runs": "runs of the solver at the posterior's maximum",
    "confirm": "confirming the posterior's maximum by the solver",
    "ladder": "setting the revisions side by side",
    "outline_basis": "principal components of the computed outlines",
    "score_database": "scores of the computed outlines",
    "score_measurements": "scores of the measured outlines",
}


def plan_words(study: str, jobs: list[Job], causes: Causes) -> str:
    """A line for each stage and below it its causes; settings files belong to their stages."""
    if not jobs:
        return f"{study}: nothing to do. The results fit the study, its table and the programs."
    stages: dict[tuple[str, str], list[Job]] = {}
    for job in jobs:
        if job.rule != "settings":
            stages.setdefault((job.rule, job.revision), []).append(job)
    count = f"{len(stages)} stage{'s' * (len(stages) != 1)} would run"
    lines = [f"{study}: {count}, {runs_words(jobs, causes.rows)}."]
    for (rule, revision), members in stages.items():
        name = STAGES.get(rule, rule) + (f" [{revision}]" if revision else "")
        lines += ["", name]
        lines += [f"  because {cause}" for cause in _of_stage(members, causes)]
    return "\n".join(lines)


def _of_stage(members: list[Job], causes: Causes) -> list[str]:
    """The causes of all jobs of a stage: those of its own before what it follows from."""
    reasons: dict[str, list[str]] = {}
    for job in members:
        for kind, files in job.reasons.items():
            known = reasons.setdefault(kind, [])
            known += [name for name in files if name not in known]
    first, missing = members[0], "missing" in reasons
    own = [cause for kind, files in reasons.items() for cause in causes.own(first, kind, files)]
    earlier = []
    for file in reasons.get("follows", []):
        rule = causes.makers[file].rule if file in causes.makers else ""
        if rule == "settings":
            # Of a stage that has never run its settings are no news.
            own += causes.of_settings(file) if Path(file).exists() or not missing else []
        else:
            earlier.append(STAGES.get(rule, file))
    own += causes.masked(first, own)
    if earlier:
        in_order = sorted(set(earlier), key=[*STAGES.values(), *earlier].index)
        own.append(f"it follows from {', '.join(in_order)}")
    return list(dict.fromkeys(own))
