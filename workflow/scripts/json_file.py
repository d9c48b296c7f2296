"""Reads and writes JSON files."""

import json
from pathlib import Path

from atomic_file import write_text
from input_errors import InputError


def read_json(path: str | Path, schema: str | None = None) -> dict:
    """InputError when the file is not JSON, or of another schema than is read here."""
    try:
        content = json.loads(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}).") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: is not text. Delete the file and run again.") from error
    except json.JSONDecodeError as error:
        problem = f"{path}, line {error.lineno}: {error.msg} (expected JSON)."
        raise InputError(f"{problem} Delete the file and run again.") from error
    if schema and content.get("schema") != schema:
        raise InputError(
            f"{path}: schema = {content.get('schema')!r} (expected {schema!r}). Delete the file "
            "and run again with programs of this version."
        )
    return content


def write_json(path: str | Path, content: dict) -> None:
    write_text(path, json.dumps(content, indent=1, allow_nan=False) + "\n")
