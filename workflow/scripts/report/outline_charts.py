"""Measured outlines over the predicted ones, and what their components look like."""

import numpy as np

from outlines.basis import OutlineBasis
from outlines.measured import read_outline
from report.chart import ACCENT, Band, Chart, Line, Panel, Points
from report.results import Results
from report.words import listed, shape_words
from size_kinds import OUTLINE_SCORES

NORMAL_95 = 1.96
PLUS, MINUS = "#d9772f", "#2f9e73"


def outline_charts(results: Results) -> list[Chart]:
    """None where the study compares no outlines."""
    if results.outlines is None:
        return []
    charts = [_shot_chart(results)]
    shapes = {shot["shape"] for shot in results.comparison["shots"] if _scores(shot)}
    basis = results.outlines.basis
    return charts + [_component_chart(basis, shape) for shape in basis.shapes if shape in shapes]


def _scores(shot: dict) -> dict:
    """Cells of a shot's scores by name."""
    return {cell["size"]: cell for cell in shot["sizes"] if cell["size"] in OUTLINE_SCORES}


def _shot_chart(results: Results) -> Chart:
    rows = {row["id"]: row for row in results.rows}
    panels, lacking = [], []
    for shot in results.comparison["shots"]:
        cells = _scores(shot)
        if len(cells) == len(OUTLINE_SCORES):
            panels.append(_shot_panel(results, rows[shot["id"]], shot, cells))
        elif cells:
            lacking.append(shot["id"])
    caption = (
        "Dots are measured radii with one standard error. Of the calibrated model: the line at its "
        "best parameters, and a shade with 95 % of the outlines that the posterior predicts, the "
        "components taken as independent; both stand for the computed outline as far as "
        f"{len(OUTLINE_SCORES)} components tell it. Heights of the model are those of the measured "
        "length, whose own deviation is shown with the lengths."
    )
    if lacking:
        caption += f" Not drawn, for the dots do not tell all components: {listed(lacking)}."
    return Chart("outlines", "Outlines", caption, panels, columns=2, row_height=300, legend=True)


def _shot_panel(results: Results, row: dict, shot: dict, cells: dict) -> Panel:
    outlines = results.outlines
    measured = read_outline(row, outlines.table, results.settings["outlines"]["radius_sd_mm"])
    first_radius = row["initial_diameter_mm"] / 2
    fractions = outlines.basis.fractions
    column = [cells[name] for name in OUTLINE_SCORES]
    best = np.array([cell["predicted"] for cell in column]) / first_radius
    ends = [(cell["predictive_lower"], cell["predictive_upper"]) for cell in column]
    middle = np.array([sum(pair) / 2 for pair in ends]) / first_radius
    sd = np.array([(high - low) / 2 / NORMAL_95 for low, high in ends]) / first_radius
    components = outlines.basis.shapes[shot["shape"]].components
    half = NORMAL_95 * np.sqrt((sd**2) @ components**2)
    centre = outlines.basis.outline(shot["shape"], middle, fractions)
    height = (fractions * measured.length_mm).tolist()
    line = outlines.basis.outline(shot["shape"], best, fractions) * first_radius
    rms = outlines.projections[shot["id"]]["rms"]
    held = "" if shot["use"] == "calibrate" else ", held back"
    return Panel(
        [
            Band(
                height,
                ((centre - half) * first_radius).tolist(),
                ((centre + half) * first_radius).tolist(),
            ),
            Line(height, line.tolist(), ACCENT, legend="model"),
            Points(
                measured.height_mm.tolist(),
                measured.radius_mm.tolist(),
                "ink",
                y_error=measured.radius_sd_mm.tolist(),
                hollow=bool(held),
                size=5,
                legend="measured",
            ),
        ],
        f"{shot['id']}, {shot['velocity_m_s']:g} m/s{held} (dots {rms:.1f} s.e. rms off the basis)",
        "height above the impact face, mm",
        "radius, mm",
    )


def _component_chart(basis: OutlineBasis, shape: str) -> Chart:
    """The mean outline, and it with each component two standard deviations up and down."""
    of_shape = basis.shapes[shape]
    height = basis.fractions.tolist()
    panels = []
    for k, component in enumerate(of_shape.components):
        change = 2 * of_shape.spread[k] * component
        layers = [
            Line(height, (of_shape.mean + change).tolist(), PLUS, legend="+ 2 s.d."),
            Line(height, of_shape.mean.tolist(), "ink", legend="mean of the runs"),
            Line(height, (of_shape.mean - change).tolist(), MINUS, legend="− 2 s.d."),
        ]
        title = f"{k + 1}: {of_shape.words[k]} ({100 * of_shape.share[k]:.2g} %)"
        panels.append(Panel(layers, title, "height / final length", "radius / initial radius"))
    return Chart(
        f"outline_components_{shape}",
        f"Components of the outline, {shape_words(shape)}",
        f"What the scores outline_pc_1 to {len(panels)} stand for: principal components of "
        f"{of_shape.runs} computed outlines, heights weighed by the length that they stand for; in "
        "brackets the share of the variance.",
        panels,
        columns=2,
        row_height=240,
        legend=True,
    )
