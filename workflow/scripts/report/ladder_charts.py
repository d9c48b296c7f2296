"""Pictures of the revisions: how the error fell, and where."""

from math import sqrt

from report.chart import PALETTE, Chart, Line, Panel, Points, Spans
from report.diagnosis_results import DiagnosisResults
from report.ladder import revision_words
from report.residual_charts import BY_SHAPE_SIZE_THIRD
from report.words import THIRDS, relative_words, shape_words, size_words

USES = (("calibrate", "fitted shots", False), ("validate", "shots held back", True))
BEFORE, AFTER, SOLVER = "#8a929b", PALETTE[0], PALETTE[1]
MOST_PANELS = 9


def ladder_chart(results: DiagnosisResults) -> Chart:
    """Misfit and evidence of each revision; also a picture for a README."""
    revisions = results.ladder
    names = [revision_words(revision) for revision in revisions]
    panels = [_misfit_panel(results, names)] if len(revisions) > 1 else []
    if panels and all(revision.get("log_evidence") is not None for revision in revisions):
        panels.append(_evidence_panel(revisions, names))
    return Chart(
        "ladder",
        "How the error fell",
        "Left: misfit of shots fitted and held back, root mean square of the whitened deviations; "
        "1 (grey) is what the errors explain. Diamonds: the solver itself in place of the "
        "network, at the best parameters. Right: how much more probable the data are than under "
        "the model without effects; 3 means 20 to 1. A true effect lowers both misfits.",
        panels,
        columns=max(len(panels), 1),
        row_height=96 + 44 * len(names),
        legend=True,
        shared_rows=True,
    )


def _misfit_panel(results: DiagnosisResults, names: list[str]) -> Panel:
    layers = [Line([1, 1], [-0.5, len(names) - 0.5], "faint", width=1.6)]
    highest = 1.0
    for use, words, hollow in USES:
        rows, values = _values([revision["misfit"] for revision in results.ladder], use)
        if not rows:
            continue
        layers.append(Line(values, rows, AFTER, dashed=hollow, width=1.4))
        points = Points(values, rows, AFTER, hollow=hollow, legend=words, size=10)
        points.labels = [f"{words}: {value:.2f} standard errors" for value in values]
        layers.append(points)
        misfits = [
            results.confirmations.get(revision["id"], {}).get("misfit", {})
            for revision in results.ladder
        ]
        confirmed, by_solver = _values(misfits, use)
        if confirmed:
            style = {"hollow": hollow, "symbol": "diamond", "legend": f"{words}, by the solver"}
            layers.append(Points(by_solver, confirmed, SOLVER, **style))
        highest = max(highest, *values, *by_solver)
    return Panel(
        layers,
        "misfit of the shots",
        "standard errors; 1 is what the errors explain",
        y_ticks=names,
        x_range=(0, 1.12 * highest),
    )


def _values(misfits: list[dict], use: str) -> tuple[list[int], list[float]]:
    found = [
        (row, misfit[use]["whitened_rms"])
        for row, misfit in enumerate(misfits)
        if misfit.get(use) and misfit[use]["n"]
    ]
    return [row for row, _ in found], [value for _, value in found]


def _evidence_panel(revisions: list[dict], names: list[str]) -> Panel:
    gains = [revision["log_evidence"] - revisions[0]["log_evidence"] for revision in revisions]
    rows = list(range(len(names)))
    bars = Spans(rows[1:], [0.0] * (len(rows) - 1), gains[1:], PALETTE[2], 16)
    bars.labels = [f"{gain:+.1f}" for gain in gains[1:]]
    texts = [f"{gain:+.1f}".replace("-", "−") for gain in gains[1:]]
    ends = Points([max(gain, 0.0) for gain in gains[1:]], rows[1:], PALETTE[2], size=1, texts=texts)
    low, high = min(0.0, *gains), max(0.0, *gains)
    room = 0.18 * (high - low or 1)
    zero = Line([0, 0], [-0.5, len(rows) - 0.5], "faint", width=1)
    limits = (low - 0.2 * room if low < 0 else 0.0, high + room)
    return Panel(
        [zero, bars, ends],
        "gain of ln Z",
        "ln Z less that of the first",
        y_ticks=names,
        x_range=limits,
    )


def shape_chart(results: DiagnosisResults) -> Chart:
    """Misfit of each shape by third of the velocities, a line for each revision."""
    shapes: dict[str, list] = {}
    for place, revision in enumerate(results.ladder):
        for shape, values in _misfit_by_shape(revision["groups"]).items():
            shapes.setdefault(shape, []).append((place, values))
    count = len(results.ladder)
    panels = []
    for shape, entries in shapes.items():
        layers = [Line([-0.3, 2.3], [1, 1], "faint", width=1.6)]
        for place, values in entries:
            x = [index for index, value in enumerate(values) if value is not None]
            y = [value for value in values if value is not None]
            colour = PALETTE[(place - 1) % len(PALETTE)] if place else BEFORE
            words = revision_words(results.ladder[place])
            layers.append(Line(x, y, colour, dashed=place == 0))
            layers.append(Points(x, y, colour, legend=words, legend_rank=place))
        largest = max(value for _, values in entries for value in values if value is not None)
        panels.append(
            Panel(
                layers,
                shape_words(shape),
                "velocity, m/s",
                "misfit, standard errors",
                x_ticks=list(results.thirds.values()),
                y_range=(0, 1.15 * max(largest, 1)),
            )
        )
    return Chart(
        "ladder_by_shape",
        "Misfit by shape, before and after",
        "Root mean square of the whitened deviations of all sizes, shots fitted and held back "
        "together, for each third of the velocities; 1 (grey) is what the errors explain.",
        panels if count > 1 else [],
        columns=min(4, max(len(panels), 2)),
        row_height=250,
        legend=True,
    )


def _by_shape_size_third(groups: list[dict]) -> dict[tuple, dict]:
    return {
        tuple(group["key"].split(" x ")): group
        for group in groups
        if group["by"] == BY_SHAPE_SIZE_THIRD
    }


def _misfit_by_shape(groups: list[dict]) -> dict[str, list[float | None]]:
    """For each shape its whitened root mean square in each third of the velocities."""
    found = _by_shape_size_third(groups)
    misfits = {}
    for shape in dict.fromkeys(key[0] for key in found):
        values = []
        for third in THIRDS:
            cells = [g for key, g in found.items() if key[0] == shape and key[2] == third]
            count = sum(cell["n"] for cell in cells)
            chi2 = sum(cell["n"] * cell["whitened_rms"] ** 2 for cell in cells)
            values.append(sqrt(chi2 / count) if count else None)
        misfits[shape] = values
    return misfits


def size_chart(results: DiagnosisResults) -> Chart:
    """Mean deviation of a size of a shape, before the first and after the last effect; those
    that deviated most before.
    """
    if len(results.ladder) < 2:
        return Chart("ladder_by_size", "", "")
    first, last = (_by_shape_size_third(results.ladder[i]["groups"]) for i in (0, -1))
    largest: dict[tuple, float] = {}
    for (shape, size, _), group in first.items():
        weight = abs(group["mean_whitened"]) * sqrt(group["n"])
        largest[shape, size] = max(largest.get((shape, size), 0), weight)
    worst = sorted(largest, key=lambda pair: -largest[pair])[:MOST_PANELS]
    several = len({shape for shape, _ in largest}) > 1
    panels = [_size_panel(results.thirds, first, last, *pair, several) for pair in worst]
    which = (
        f" The {MOST_PANELS} worst before, of {len(largest)}." if len(largest) > len(worst) else ""
    )
    return Chart(
        "ladder_by_size",
        "Measured − model by size, before and after",
        f"Mean deviation, {relative_words([size for _, size in worst])}, for each third of the "
        f"velocities. After: with all effects of the last revision.{which}",
        panels,
        columns=3,
        row_height=230,
        legend=True,
    )


def _size_panel(
    thirds: dict[str, str], first: dict, last: dict, shape: str, size: str, several: bool
) -> Panel:
    layers = [Line([-0.3, 2.3], [0, 0], "faint", width=1)]
    for groups, colour, words in ((first, BEFORE, "before"), (last, AFTER, "after")):
        found = [groups.get((shape, size, third)) for third in thirds]
        x = [index for index, cell in enumerate(found) if cell]
        y = [100 * cell["mean_relative"] for cell in found if cell]
        layers.append(Line(x, y, colour, dashed=words == "before"))
        layers.append(Points(x, y, colour, legend=words))
    title = f"{shape_words(shape)}, {size_words(size)}" if several else size_words(size)
    ticks = list(thirds.values())
    return Panel(layers, title, "velocity, m/s", "measured − model, %", x_ticks=ticks)


def confirmation_chart(results: DiagnosisResults) -> Chart:
    """Whitened deviation of each size by the solver, against that by the network."""
    panels = []
    for revision in results.ladder:
        confirmation = results.confirmations.get(revision["id"])
        if confirmation:
            panels.append(_confirmation_panel(revision, confirmation))
    return Chart(
        "confirmation",
        "Network against solver at the best parameters",
        "For every measured size, the solver's own size against the network's, both in per cent "
        "above or below the measured one. On the line the network spoke for the solver.",
        panels,
        columns=max(len(panels), 2),
        row_height=290,
        legend=True,
    )


def _confirmation_panel(revision: dict, confirmation: dict) -> Panel:
    layers, all_values = [], []
    for use, words, hollow in USES:
        cells = [
            (shot, cell)
            for shot in confirmation["shots"]
            if shot["use"] == use
            for cell in shot["sizes"]
            if cell["measured"]
        ]
        if not cells:
            continue
        network, solver = (
            [100 * (cell[key] / cell["measured"] - 1) for _, cell in cells]
            for key in ("network", "solver")
        )
        labels = [f"<b>{shot['id']}</b><br>{size_words(cell['size'])}" for shot, cell in cells]
        points = Points(network, solver, AFTER, hollow=hollow, labels=labels, legend=words, size=6)
        layers.append(points)
        all_values += network + solver
    ends = [min(all_values, default=0), max(all_values, default=1)]
    layers.insert(0, Line(ends, ends, "faint", width=1))
    return Panel(layers, revision_words(revision), "network, %", "solver, %")
