"""How many runs of the solver a plan asks for."""

from pathlib import Path

from why.plan import Job


def runs_words(jobs: list[Job], rows: list[dict]) -> str:
    """`rows`: the table; the confirmation has one run for each shot in use."""
    count = saved = 0
    for job in jobs:
        if job.rule == "confirmation_runs":
            count += sum(row["use"] != "ignore" for row in rows)
        elif job.rows is not None:
            count += job.rows
            if not set(job.reasons) - {"missing", "interrupted"}:
                saved += _in_journal(Path(f"{job.outputs[0]}.journal.jsonl"))
    if not count:
        return "without a run of the solver"
    kept = f" ({saved} of them are in the journal of a batch that was stopped)" if saved else ""
    return f"with {count} run{'s' * (count != 1)} of the solver{kept}"


def _in_journal(journal: Path) -> int:
    """Runs that a batch had finished: a line each, after a line that says what it computes."""
    if not journal.exists():
        return 0
    return max(0, journal.read_bytes().count(b"\n") - 1)
