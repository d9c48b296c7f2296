"""Digests of the code that makes a result, so that it is made anew when that code changed.

A program counts by the sources that it was built from, a script by itself and the modules of
this folder that it imports. Dates do not count, nor where or how often it was built or checked
out. Snakemake notes the digest with the result, as a parameter of its rule.
"""

import ast
import hashlib
import re
import subprocess
from collections.abc import Callable
from functools import cache
from pathlib import Path

from input_errors import InputError

PROGRAMS = Path("build") / "bin"
SCRIPTS = Path(__file__).resolve().parent
# These only check what a user wrote, or word errors: what they make of it reaches a stage as its
# settings, which are noted themselves.
CHECKS = {"contradictions.py", "input_errors.py", "schema_check.py", "stage_log.py", "study.py"}
CHECKS |= {"yaml_lines.py"}
NOTE = re.compile(r"code of (\S+): ([0-9a-f]{16})")


def code_note(name: str) -> str:
    """`code of <name>: <digest>`, of a program in build/bin or a script (*.py) of this folder."""
    digest = script_digest(name) if name.endswith(".py") else program_digest(name)
    return f"code of {name}: {digest}"


def code_of(name: str) -> Callable:
    """The note as a parameter of a rule. Programs are ancient() inputs besides."""
    return lambda wildcards: code_note(name)


@cache
def program_digest(name: str) -> str:
    """16 hexadecimal digits that `<program> --version` ends in; see common/program_code.cmake."""
    program = PROGRAMS / name
    try:
        told = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
    except OSError as error:
        problem = f"cannot be run ({error.strerror})"
        raise InputError(f"{program}: {problem}. Build it first: make build.") from error
    found = re.search(r"code ([0-9a-f]{16})$", told.strip())
    if found is None:
        problem = f"does not tell the digest of its sources (it says {told.strip()!r})"
        raise InputError(f"{program}: {problem}. Build it anew: make build.")
    return found[1]


@cache
def script_digest(name: str) -> str:
    """16 hexadecimal digits; comments, docstrings and layout do not count."""
    whole = hashlib.sha256()
    for path in sorted(modules_of(name)):
        whole.update(f"{path.relative_to(SCRIPTS)} {_statements(path)}\n".encode())
    return whole.hexdigest()[:16]


def modules_of(name: str) -> set[Path]:
    """The script and the files of this folder that it imports, directly or not."""
    found: set[Path] = set()
    waiting = {SCRIPTS / name}
    while waiting:
        path = waiting.pop()
        found.add(path)
        waiting |= _imported(path) - found
    return found


@cache
def _tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def _imported(path: Path) -> set[Path]:
    names = set()
    for node in ast.walk(_tree(path)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            # What is imported from a package may be a module of it.
            names |= {node.module} | {f"{node.module}.{alias.name}" for alias in node.names}
    places = [SCRIPTS / name.replace(".", "/") for name in names]
    files = [path for place in places for path in (place.with_suffix(".py"), place / "__init__.py")]
    return {path for path in files if path.exists() and path.name not in CHECKS}


@cache
def _statements(path: Path) -> str:
    """The digest of the file's syntax tree without its docstrings."""
    described = (ast.Module, ast.ClassDef, ast.FunctionDef)
    for node in ast.walk(_tree(path)):
        if isinstance(node, described) and ast.get_docstring(node, clean=False) is not None:
            node.body[0].value.value = ""
    return hashlib.sha256(ast.dump(_tree(path)).encode()).hexdigest()
