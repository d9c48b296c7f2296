"""How well the network stands in for the solver, and what the study cost."""

import numpy as np

from report.chart import PALETTE, Bars, Chart, Histogram, Line, Panel, Points
from report.results import Results
from report.stages import STAGES
from report.words import duration, shape_words, size_words


def network_chart(results: Results) -> Chart:
    """Held-out runs: how far the network is from the solver."""
    pairs = results.emulator["validation"]["pairs"]
    shapes = list(dict.fromkeys(pair["shape"] for pair in pairs))
    panels = []
    for output in dict.fromkeys(pair["output"] for pair in pairs):
        layers = []
        for index, shape in enumerate(shapes):
            mine = [p for p in pairs if p["output"] == output and p["shape"] == shape]
            solver = [pair["solver"] for pair in mine]
            error = [pair["network"] - pair["solver"] for pair in mine]
            words = shape_words(shape) if len(shapes) > 1 else ""
            colour = PALETTE[index % len(PALETTE)]
            layers.append(Points(solver, error, colour, size=4.5, legend=words))
        spread = [value for layer in layers for value in layer.x]
        if not spread:
            continue
        layers.insert(0, Line([min(spread), max(spread)], [0, 0], "faint", width=1))
        x_label, y_label = "solver, mm", "network − solver, mm"
        panels.append(Panel(layers, size_words(output), x_label, y_label))
    return Chart(
        "network_against_solver",
        "Network against solver",
        "Runs that the network did not see in training. The deviation enters the likelihood.",
        panels,
        columns=min(3, max(len(panels), 2)),
        row_height=250,
        legend=len(shapes) > 1,
    )


def cost_chart(results: Results) -> Chart:
    costs = results.stage_costs
    panels = []
    if costs:
        bars = Bars(
            [STAGES[cost["stage"]].words for cost in costs],
            [cost["wall_s"] for cost in costs],
            [duration(cost["wall_s"]) for cost in costs],
        )
        longest = max(cost["wall_s"] for cost in costs)
        panels.append(Panel([bars], "time of each stage", "wall clock, s"))
        panels[0].x_range = (0, 1.25 * longest)
    if results.database.cpu_s:
        counts, edges = np.histogram(results.database.cpu_s, bins=24)
        histogram = Histogram(list(edges), counts.tolist())
        panels.append(Panel([histogram], "cost of a run", "CPU seconds", "runs"))
    return Chart(
        "costs",
        "What it cost",
        "Times of the stages as they were last run, and CPU seconds of each solver run.",
        panels,
        columns=2,
        row_height=260,
    )
