"""The scores as a figure: shares with their intervals, and what was said of each hidden effect."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from judge import Answer, Case  # noqa: E402

SAID = ["effect, right", "set with it", "set without it", "effect, wrong"]
SAID += ["outside the list", "bad data", "no effect supported"]
COLOURS = ["#1b7837", "#a6dba0", "#fdb863", "#b2182b", "#8073ac", "#878787", "#e0e0e0"]


def said(case: Case) -> str:
    """The verdict against what is hidden, one of SAID."""
    kind = case.verdict["kind"]
    if kind == "effect":
        return "effect, wrong" if case.names_one_wrongly else "effect, right"
    if kind in SAID:
        return kind
    return "set with it" if set(case.hidden) & case.named else "set without it"


def draw(answers: list[Answer], cases: list[Case], path: Path) -> None:
    figure, (left, right) = plt.subplots(1, 2, figsize=(15, 7), layout="constrained")
    figure.suptitle("Blind tables made by our own solver (synthetic)")
    _shares(left, [answer for answer in answers if answer.trials])
    _verdicts(right, cases)
    figure.savefig(path, dpi=110, metadata={"Software": None})
    plt.close(figure)


def _shares(axes, answers: list[Answer]) -> None:
    """Share of each question with its interval; a bar where the acceptance is."""
    for row, answer in enumerate(answers):
        lowest, highest = answer.interval
        wanted = (answer.question.at_least, answer.question.at_most)
        if any(limit is not None for limit in wanted):
            low, high = wanted[0] or 0, 1 if wanted[1] is None else wanted[1]
            axes.barh(row, 100 * (high - low), left=100 * low, color="#d9f0d3", height=0.8)
        colour = "#b2182b" if answer.verdict == "missed" else "black"
        axes.plot([100 * lowest, 100 * highest], [row, row], color=colour)
        axes.plot(100 * answer.share, row, "o", color=colour)
    names = [f"{a.question.name} ({a.hits} of {a.trials})" for a in answers]
    axes.set_yticks(range(len(answers)), names, fontsize=8)
    axes.invert_yaxis()
    axes.set_xlim(-2, 102)
    axes.set_xlabel("per cent of the tables, 95 % interval; green: wanted")


def _verdicts(axes, cases: list[Case]) -> None:
    """What was said, by what is hidden."""
    rows: dict[str, list[str]] = {}
    for case in sorted(cases, key=lambda case: (case.kind != "effect", case.kind)):
        what = case.hidden[0] if case.kind == "effect" else case.kind
        rows.setdefault(what, []).append(said(case))
    left = np.zeros(len(rows))
    for word, colour in zip(SAID, COLOURS, strict=True):
        share = np.array([100 * words.count(word) / len(words) for words in rows.values()])
        axes.barh(range(len(rows)), share, left=left, color=colour, label=word)
        left += share
    names = [f"{what} ({len(words)})" for what, words in rows.items()]
    axes.set_yticks(range(len(rows)), names, fontsize=8)
    axes.invert_yaxis()
    axes.set_xlabel("what was said, per cent of the tables")
    axes.legend(fontsize=8, loc="upper right", bbox_to_anchor=(1.0, 1.08), ncol=4)
