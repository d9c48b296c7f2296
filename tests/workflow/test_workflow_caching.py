"""Why Snakemake's own caching between workflows is not used: a program built anew finds nothing."""

import os
import subprocess

from tiny_study import SNAKEMAKE

SNAKEFILE = """
rule made:
    input: program="program"
    output: "made.txt"
    cache: True
    shell: "sh {input.program} > {output}"
"""


def entries(tmp_path, name: str, program: str) -> int:
    """Runs a workflow of its own with the common cache; how many results that holds then."""
    folder, kept = tmp_path / name, tmp_path / "cache"
    folder.mkdir()
    kept.mkdir(exist_ok=True)
    (folder / "Snakefile").write_text(SNAKEFILE)
    (folder / "program").write_text(program)
    command = [SNAKEMAKE, "--cores", "1", "--cache", "made", "made.txt"]
    environment = {**os.environ, "SNAKEMAKE_OUTPUT_CACHE": str(kept)}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (folder / "made.txt").read_text() == "7\n"
    return sum(path.is_file() for path in kept.iterdir())


def test_the_bytes_of_the_program_count_whatever_it_computes(tmp_path):
    assert entries(tmp_path, "first", "echo 7\n") == 1
    assert entries(tmp_path, "second", "echo 7\n") == 1, "the same bytes are found"
    assert entries(tmp_path, "rebuilt", "echo 7  # of another commit\n") == 2
