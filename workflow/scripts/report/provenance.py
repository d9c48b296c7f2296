"""Which programs, seeds and settings made each file."""

import json
from pathlib import Path

from file_digest import sha256_of
from report.results import Results
from report.stages import STAGES

# What each stage reads besides its settings, by the names of the report's inputs.
READ_BY = {
    "database": [],
    "emulator": ["database"],
    "posterior": ["emulator", "measurements"],
    "comparison": ["posterior", "emulator", "measurements"],
}


def provenance_tables(results: Results, inputs: dict[str, Path]) -> list[dict]:
    """For each stage its provenance as rows and its configuration as text."""
    stages = [
        ("Database", "database", results.database.attributes),
        ("Network", "emulator", results.emulator),
        ("Posterior", "posterior", results.posterior.attributes),
        ("Comparison", "comparison", results.comparison),
    ]
    tables = []
    for title, name, record in stages:
        table = stage_provenance(title, record)
        table["rows"] += _files(name, inputs) + _costs(name, results.stage_costs)
        tables.append(table)
    return tables


def _files(name: str, inputs: dict[str, Path]) -> list[tuple[str, str]]:
    rows = [("SHA-256", sha256_of(inputs[name]))]
    return rows + [(f"made from {inputs[of].name}", sha256_of(inputs[of])) for of in READ_BY[name]]


def _costs(name: str, costs: list[dict]) -> list[tuple[str, str]]:
    own = [cost for cost in costs if STAGES[cost["stage"]].result == name]
    if not own:
        return []
    wall_s, cpu_s = (sum(cost[key] for cost in own) for key in ("wall_s", "cpu_s"))
    hosts = sorted({host for cost in own for host in cost["hosts"]})
    rows = [("computed on", ", ".join(hosts))] if hosts else []
    return [*rows, ("wall and CPU seconds", f"{wall_s:.1f}, {cpu_s:.1f}")]


def stage_provenance(title: str, record: dict) -> dict:
    """One stage: its title, its provenance as rows, its configuration as text."""
    facts = dict(record.get("provenance", {}))
    configuration = facts.pop("configuration", None) or record.get("configuration")
    return {
        "title": title,
        "rows": [(name.replace("_", " "), _text(value)) for name, value in facts.items()],
        "configuration": json.dumps(configuration, indent=2) if configuration else "",
    }


def _text(value) -> str:
    return value if isinstance(value, str) else json.dumps(value)
