"""Digests of files."""

import hashlib
from functools import cache
from pathlib import Path


@cache
def sha256_of(path: Path) -> str:
    """What `sha256sum` prints."""
    with Path(path).open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
