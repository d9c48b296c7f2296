"""A study so small that its whole chain runs in seconds, and a folder to run it in."""

import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SNAKEMAKE = "/usr/bin/snakemake"
STUDY = "tiny"

STUDY_YAML = """\
title: Four shots
material: copper

parameters:
  rho_immobile_initial: { lower: 1.0e+12, upper: 1.0e+14, prior: log_uniform, scope: per_lot }
  hardening_coefficient: { lower: 1, upper: 5, prior: uniform, scope: shared }

solver:
  geometry: axisymmetric
  fidelity: coarse

database:
  runs: 24
  chunks: 2
  shapes: [uniform_cylinder]
  velocity_m_s: [100, 210]
  initial_diameter_mm: [7, 8]
  length_to_diameter: [1.5, 5]
  initial_temperature_K: [290, 305]

emulator:
  outputs: [final_length_mm, impact_diameter_mm]
  hidden_layers: 2
  members: 2
  epochs: 60
  batch_sizes: [8]

calibration:
  fit_sizes: [final_length_mm, impact_diameter_mm]
  draws: 2000
  draws_per_lot: 8
  kept_draws: 200
"""

TABLE = """\
id,lot,use,shape,initial_temperature_K,velocity_m_s,initial_diameter_mm,initial_length_mm,\
final_length_mm,final_length_mm_sd,impact_diameter_mm,impact_diameter_mm_sd,source,note
a1,first,calibrate,uniform_cylinder,294,161,7.595,15.19,12.4,0.087,11.7,0.292,House 1995,
a2,first,calibrate,uniform_cylinder,294,169,7.595,15.19,12.1,0.085,12.1,0.302,House 1995,
a3,first,validate,uniform_cylinder,294,200,7.595,22.785,16.9,0.118,14.2,0.355,House 1995,
b1,second,calibrate,uniform_cylinder,295,190,7.62,25.4,16.21,0.113,13.56,0.339,"J, C",
"""
NEW_ROW = "b2,second,calibrate,uniform_cylinder,295,130,7.62,25.4,19.56,0.137,9.91,0.248,JC,\n"


def write_study(folder: Path, study: str = STUDY_YAML, table: str = TABLE) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "study.yaml").write_text(study)
    (folder / "measurements.csv").write_text(table)
    return folder


class Workspace:
    """A folder with the repository's workflow and programs, and results of its own."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.study = folder / "experiments" / STUDY
        self.results = folder / "results" / STUDY

    def command(self, *options: str) -> list[str]:
        return [SNAKEMAKE, *options, "--cores", "2", "--config", f"study={STUDY}"]

    def run(self, *options: str) -> subprocess.CompletedProcess:
        """Runs snakemake; what it says is in `stdout`, whichever stream it chose."""
        return subprocess.run(
            self.command(*options),
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def planned_rules(self) -> set[str]:
        """The rules that a dry run would execute."""
        done = self.run("--dry-run")
        assert done.returncode == 0, done.stdout
        lines = done.stdout.splitlines()
        return {
            line.split()[1].rstrip(":")
            for line in lines
            if line.startswith(("rule ", "localrule "))
        }


def copy_workspace(workspace: Workspace, folder: Path) -> Workspace:
    """A copy that a test may change."""
    shutil.copytree(workspace.folder, folder, symlinks=True)
    return Workspace(folder)


def make_workspace(folder: Path, build: Path) -> Workspace:
    """The workflow and the programs by links, the study and the results in the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "Snakefile").symlink_to(ROOT / "Snakefile")
    (folder / "workflow").symlink_to(ROOT / "workflow")
    (folder / "build").symlink_to(build)
    workspace = Workspace(folder)
    write_study(workspace.study)
    return workspace


def use_own_workflow(workspace: Workspace) -> None:
    """Copies of the Snakefile and the workflow, which a test may change."""
    for name in ("Snakefile", "workflow"):
        path = workspace.folder / name
        if path.is_symlink():
            source = path.resolve()
            path.unlink()
            copy = shutil.copytree if source.is_dir() else shutil.copy2
            copy(source, path)


def use_stand_ins(workspace: Workspace, codes: dict[str, str]) -> None:
    """Programs as if rebuilt from another commit: with new dates, another revision and the same
    digest of their sources, but for those whose digest `codes` names. They call the real ones.
    """
    build = workspace.folder / "build"
    real = build.resolve() / "bin"
    build.unlink()
    (build / "bin").mkdir(parents=True)
    for name in ("solver", "emulator", "calibrate"):
        told = subprocess.run([real / name, "--version"], capture_output=True, text=True).stdout
        code = codes.get(name, told.split()[-1])
        answer = f"{name} 0.1.0 (0000000000), code {code}"
        program = build / "bin" / name
        program.write_text(
            f'#!/bin/sh\n[ "$1" = --version ] && echo "{answer}" || exec {real / name} "$@"\n'
        )
        program.chmod(0o755)
