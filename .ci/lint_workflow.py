"""Runs `snakemake --lint` and fails on every finding but the wish for conda or a container.

The workflow calls programs built from this repository and Debian's own Python, which
`make setup` installs, so a conda environment for each rule would describe nothing.
"""

import json
import subprocess
import sys

WAIVED = "Specify a conda environment or container for each rule."


SNAKEFILES = ["Snakefile", "tests/verification/Snakefile"]
SNAKEFILES += ["tests/discovery/Snakefile", "tests/discovery/study/Snakefile"]
SNAKEFILES += ["experiments/equation_of_state/Snakefile"]


def lint(snakefile: str) -> int:
    command = ["/usr/bin/snakemake", "--snakefile", snakefile, "--lint", "json", "--cores", "1"]
    run = subprocess.run(command, capture_output=True, text=True)
    try:
        report = json.loads(run.stdout)
    except json.JSONDecodeError:
        print(run.stdout, run.stderr, sep="\n", file=sys.stderr)
        return 1
    findings = [
        f"{item['for']}: {found['title']}"
        for part in report.values()
        for item in part
        for found in item["lints"]
        if found["title"] != WAIVED
    ]
    print(*findings, sep="\n", end="\n" if findings else "")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(max(lint(snakefile) for snakefile in SNAKEFILES))
