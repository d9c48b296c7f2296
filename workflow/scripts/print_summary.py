"""Prints what a study found: parameters with intervals, misfit, and where the report is.

/usr/bin/python3 workflow/scripts/print_summary.py results/copper_measured
"""

import argparse
import sys
from pathlib import Path

from input_errors import InputError
from json_file import read_json
from misfit_by_size import misfit_by_size

MOST_FINDINGS = 5
USE_WORDS = {"calibrate": "fitted", "validate": "held back"}


def summary(results: Path) -> str:
    if not (results / "comparison.json").exists():
        raise InputError(f"{results}: holds no comparison.json (expected the results of a study).")
    comparison = read_json(results / "comparison.json")
    settings = read_json(results / "config" / "report.json")
    lines = [settings["title"] + (" (synthetic data)" if settings["synthetic"] else ""), ""]
    width = max(len(entry["name"]) for entry in comparison["parameters"])
    lines.append(f"{'calibrated parameter':<{width}}  {'median':>10}  95 % interval")
    for entry in comparison["parameters"]:
        base = entry["name"].partition("[")[0]
        unit = settings["parameters"].get(base, {}).get("unit", "none")
        interval = f"{entry['lower95']:.3g} to {entry['upper95']:.3g}"
        unit = "" if unit == "none" else f" {unit}"
        lines.append(f"{entry['name']:<{width}}  {entry['median']:>10.3g}  {interval}{unit}")
    lines.append("")
    for use, misfit in comparison["misfit"].items():
        if misfit["n"]:
            lines.append(
                f"misfit, {USE_WORDS[use]}: {misfit['whitened_rms']:.2f} standard errors "
                f"(root mean square of {misfit['n']} data)"
            )
            for size, share in misfit_by_size(comparison, use).items():
                lines.append(f"  {size:<24}{100 * share:6.2f} % of the size before impact")
    lines += ["", "what stands out:" if comparison["findings"] else "nothing stands out"]
    lines += [f"  {words}" for words in comparison["findings"][:MOST_FINDINGS]]
    return "\n".join([*lines, "", f"report: {results / 'report.html'}"])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path, help="folder of the study's results")
    try:
        print(summary(parser.parse_args().results))
    except InputError as error:
        sys.exit(f"print_summary.py: {error}")
