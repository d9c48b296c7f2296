"""What Snakemake noted of a file when it was made: settings, and digests of the code."""

import ast
import base64
import json
from pathlib import Path

from code_digest import NOTE, code_note

METADATA = Path(".snakemake") / "metadata"


def record_of(output: str) -> dict | None:
    """All that Snakemake noted when it made a file; None if it did not."""
    record = METADATA / base64.urlsafe_b64encode(output.encode()).decode()
    try:
        return json.loads(record.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def recorded_parameters(output: str) -> list | None:
    """The rule's parameters that Snakemake noted when it made a file; None if it did not."""
    try:
        return [ast.literal_eval(text) for text in record_of(output)["params"]]
    except (TypeError, KeyError, ValueError, SyntaxError):
        return None


def recorded_settings(output: str) -> dict | None:
    """Those of them that are a stage's settings."""
    found = [value for value in recorded_parameters(output) or [] if isinstance(value, dict)]
    return found[0] if found else None


def recorded_codes(output: str) -> dict[str, str]:
    """Notes of the code that made a file, by the name of the program or script."""
    texts = [value for value in recorded_parameters(output) or [] if isinstance(value, str)]
    return {found[1]: found[0] for found in map(NOTE.fullmatch, texts) if found}


def code_changes(output: str) -> list[str]:
    """Programs and scripts that changed since they made a file."""
    codes = recorded_codes(output)
    return [_changed(name) for name, note in codes.items() if note != code_note(name)]


def _changed(name: str) -> str:
    if name.endswith(".py"):
        return f"workflow/scripts/{name}, or a module that it imports, changed"
    return f"the program {name} changed"
