"""Which programs, seeds and settings made each file."""

import json

from report.results import Results


def provenance_tables(results: Results) -> list[dict]:
    """For each stage its provenance as rows and its configuration as text."""
    stages = [
        ("Database", results.database.attributes),
        ("Network", results.emulator),
        ("Posterior", results.posterior.attributes),
        ("Comparison", results.comparison),
    ]
    return [stage_provenance(title, record) for title, record in stages]


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
