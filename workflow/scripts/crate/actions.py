"""What made each result, as Snakemake noted it and as the result's own provenance says."""

import json
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

from code_digest import NOTE
from hdf5_file import opened
from job_log import JobRecord, job_record
from json_file import read_json
from why.records import record_of


@dataclass
class Action:
    """A job of the workflow, and all that it wrote."""

    rule: str
    command: str
    code: dict[str, str]  # digest of the sources, by program or script
    inputs: list[str]
    outputs: list[str]
    start: str
    end: str
    job: JobRecord  # where, and what it cost


def actions_of(files: list[str]) -> list[Action]:
    """The jobs that made the files, in the order of their ends; files without a note are left."""
    found: dict[tuple, Action] = {}
    for file in files:
        record = record_of(file)
        if record is None:
            continue
        key = (record["rule"], record["starttime"], *record["log"])
        if key in found:
            found[key].outputs.append(file)
        else:
            found[key] = _action(file, record)
    return sorted(found.values(), key=lambda action: action.end)


def _action(file: str, record: dict) -> Action:
    notes = [NOTE.fullmatch(text.strip("'")) for text in record["params"]]
    job = job_record(Path(record["log"][0]))
    return Action(
        rule=record["rule"],
        command=record["shellcmd"] or f"workflow/scripts, rule {record['rule']}",
        code={note[1]: note[2] for note in notes if note},
        inputs=[name for name in record["input"] if not name.startswith("build/")],
        outputs=[file],
        start=_time(record["starttime"]),
        end=_time(record["endtime"]),
        job=job,
    )


def _time(seconds: float) -> str:
    return datetime.fromtimestamp(seconds, timezone.utc).isoformat(timespec="seconds")


def provenance_in(path: Path) -> dict:
    """Program, version, seed, configuration and machine that a result itself names."""
    if path.suffix == ".h5":
        with opened(path) as file:
            text = file.attrs.get("provenance", "{}")
        return json.loads(text if isinstance(text, str) else text.decode())
    if path.suffix == ".json":
        content = read_json(path)
        return content.get("provenance", {}) if isinstance(content, dict) else {}
    return {}
