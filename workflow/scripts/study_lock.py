"""Snakemake's lock on a study: who holds it, and how to go on after a kill.

A workflow writes the names of its files to `.snakemake/locks/` and removes them when it ends,
but not when it was killed. The lock does not say whose it is, so that only processes of this
machine can be looked for.
"""

from pathlib import Path

import psutil

from input_errors import InputError

LOCKS = Path(".snakemake") / "locks"


def check_unlocked(study: str) -> None:
    """InputError with the remedy when a workflow holds files of the study."""
    if not is_locked(study):
        return
    running = workflows_here()
    if running:
        raise InputError(
            f"{study}: another workflow is computing it (process {running[0]}). Wait for it to "
            "end, or stop it; what it has finished is kept."
        )
    raise InputError(
        f"{study}: locked by a workflow that was killed, or that runs on another machine. If none "
        f"runs: workflow/taylorcal unlock {study}\nNothing finished is lost."
    )


def is_locked(study: str) -> bool:
    folder = f"results/{study}/"
    return any(folder in path.read_text(encoding="utf-8") for path in LOCKS.glob("*.lock"))


def workflows_here() -> list[int]:
    """Processes of this machine that run Snakemake in this folder."""
    here = Path.cwd()
    found = []
    for process in psutil.process_iter(["pid", "cmdline", "cwd"]):
        command = process.info["cmdline"] or []
        is_snakemake = any(Path(word).name == "snakemake" for word in command[:2])
        if is_snakemake and process.info["cwd"] == str(here):
            found.append(process.info["pid"])
    return found


def refuse_while_running() -> None:
    """InputError when a workflow runs here: `snakemake --unlock` takes every lock of the folder."""
    running = workflows_here()
    if running:
        raise InputError(f"a workflow is running here (process {running[0]}). Stop it first.")
