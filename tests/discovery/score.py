"""Scores the diagnoses of the blind tables: a table for people, CSV and JSON, and a figure.

/usr/bin/python3 tests/discovery/score.py --study tests/discovery/study --tables tables \\
    --sealed sealed/tables --refits refits --out tests/discovery/results
"""

import argparse
import csv
import json
from collections import Counter
from dataclasses import replace
from pathlib import Path

from judge import Answer, Case, answers, left_over
from network import Network
from parameter_distance import distances_to_truth
from score_figure import draw


def read_cases(network: Network, tables: Path, sealed: Path, refits: Path) -> list[Case]:
    """Every table that has a diagnosis, with its truth and its refit."""
    adding: dict = {}
    for path in sorted(refits.glob("*.json")):
        adding |= json.loads(path.read_text())
    cases = []
    for path in sorted(tables.glob("*/diagnosis.json")):
        name = path.parent.name
        truth = json.loads((sealed / f"{name}.json").read_text())
        case = Case(name, truth, json.loads(path.read_text()), adding.get(name))
        if case.refit is not None:
            table = path.parent / "measurements.csv"
            distances = distances_to_truth(network, table, case.refit, truth)
            case = replace(case, distances=distances)
        cases.append(case)
    return left_over(cases)


def answer_row(answer: Answer) -> dict:
    lowest, highest = answer.interval
    return {
        "question": answer.question.name,
        "hits": answer.hits,
        "tables": answer.trials,
        "per_cent": f"{100 * answer.share:.1f}" if answer.trials else "",
        "lower95": f"{100 * lowest:.1f}" if answer.trials else "",
        "upper95": f"{100 * highest:.1f}" if answer.trials else "",
        "wanted": answer.wanted,
        "verdict": answer.verdict,
        "looked_at": " ".join(answer.misses),
    }


def case_row(case: Case) -> dict:
    """What was hidden and what was said, one line a table."""
    effects = case.truth["effects"]
    adequacy = case.diagnosis["adequacy"]
    return {
        "table": case.id,
        "kind": case.kind,
        "hidden": " ".join(case.hidden) or case.truth["material"],
        "amplitude": " ".join(f"{value:.4g}" for value in effects.values()),
        "strength": case.truth["strength"],
        "signal_sd": f"{case.signal_sd:.2f}",
        "left_sd": f"{case.left_sd:.2f}",
        "confounded": "yes" if case.is_confounded else "",
        "verdict": case.verdict["kind"],
        "flagged": "yes" if case.verdict["flagged"] else "",
        "named": " ".join(case.verdict["effects"]),
        "shots": " ".join(case.verdict["shots"]),
        "p_chi2": f"{adequacy['p_chi2']:.3g}",
        "p_battery": f"{adequacy['p_battery']:.3g}",
        "p_score": f"{adequacy['p_score']:.3g}",
    }


def markdown(rows: list[dict], cases: list[Case]) -> str:
    """The scores as the README shows them."""
    lines = [
        "| question | tables | share | 95 % interval | wanted | |",
        "|---|---|---|---|---|---|",
    ]
    for row in rows:
        share = f"{row['per_cent']} %" if row["tables"] else "-"
        limits = f"{row['lower95']} to {row['upper95']} %" if row["tables"] else "-"
        cells = [row["question"], f"{row['hits']} of {row['tables']}", share, limits]
        lines.append("| " + " | ".join([*cells, row["wanted"], row["verdict"]]) + " |")
    counts = Counter((case.kind, case.verdict["kind"]) for case in cases)
    lines += ["", "| hidden | verdict | tables |", "|---|---|---|"]
    lines += [f"| {kind} | {said} | {n} |" for (kind, said), n in sorted(counts.items())]
    return "\n".join(lines) + "\n"


def write_csv(path: Path, rows: list[dict]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("study", "tables", "sealed", "refits", "out"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    options = parser.parse_args()
    network = Network.from_file(options.study / "emulator.json")
    cases = read_cases(network, options.tables, options.sealed, options.refits)
    found = answers(cases)
    rows = [answer_row(answer) for answer in found]
    options.out.mkdir(parents=True, exist_ok=True)
    write_csv(options.out / "scores.csv", rows)
    write_csv(options.out / "tables.csv", [case_row(case) for case in cases])
    (options.out / "scores.json").write_text(json.dumps(rows, indent=1) + "\n")
    text = markdown(rows, cases)
    (options.out / "scores.md").write_text(text)
    draw(found, cases, options.out / "discovery.png")
    print(text)


if __name__ == "__main__":
    main()
