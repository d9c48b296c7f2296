"""What was measured, and the model against it."""

from misfit_by_size import size_before_impact
from report.chart import PALETTE, Band, Chart, Intervals, Line, Panel, Points
from report.chart import ordered_colour
from report.results import Results
from report.words import USE_WORDS, lot_words, sentence_case, shape_words, size_words
from size_kinds import is_radial

USE_SYMBOL = {"calibrate": {}, "validate": {"hollow": True}, "ignore": {"symbol": "cross"}}


def table_chart(results: Results) -> Chart:
    """Which velocities each lot (or shape) covers, and what becomes of each shot."""
    key, words = grouping(results)
    names = list(dict.fromkeys(row[key] for row in results.rows))
    layers = []
    for use, style in USE_SYMBOL.items():
        rows = [row for row in results.rows if row["use"] == use]
        if rows:
            layers.append(
                Points(
                    [row["velocity_m_s"] for row in rows],
                    [names.index(row[key]) for row in rows],
                    "ink" if use == "ignore" else PALETTE[0],
                    labels=[_shot_label(row) for row in rows],
                    legend=USE_WORDS[use],
                    **style,
                )
            )
    panel = Panel(layers, x_label="impact velocity, m/s", y_ticks=[words(name) for name in names])
    return Chart(
        "measured_shots",
        "Velocities of the shots",
        "Each mark is a shot: filled ones are fitted, hollow ones held back to judge the fit, "
        "crosses left out.",
        [panel],
        columns=1,
        row_height=130 + 26 * len(names),
        legend=True,
    )


def grouping(results: Results):
    """What tells the shots apart, lots or shapes, and how its values are written."""
    if len(results.lots) > 1:
        return "lot", lot_words
    return "shape", shape_words


def _shot_label(row: dict) -> str:
    ratio = row["initial_length_mm"] / row["initial_diameter_mm"]
    return (
        f"<b>{row['id']}</b><br>{row['velocity_m_s']:g} m/s, {row['initial_diameter_mm']:g} mm × "
        f"{row['initial_length_mm']:.4g} mm (L/D {ratio:.3g})<br>{row['source']}"
    )


def _ratio(row: dict) -> float:
    return round(row["initial_length_mm"] / row["initial_diameter_mm"], 2)


def velocity_charts(results: Results) -> list[Chart]:
    """For each size, a panel for each lot and shape; sizes over the initial size."""
    rows = {row["id"]: row for row in results.rows}
    sizes = list(
        dict.fromkeys(
            cell["size"] for shot in results.comparison["shots"] for cell in shot["sizes"]
        )
    )
    ratios = sorted({_ratio(row) for row in results.used_rows})
    return [_velocity_chart(results, size, rows, ratios) for size in sizes]


def _velocity_chart(results: Results, size: str, rows: dict, ratios: list[float]) -> Chart:
    panels = {}
    for shot in results.comparison["shots"]:
        for cell in shot["sizes"]:
            if cell["size"] == size:
                panels.setdefault((shot["lot"], shot["shape"]), []).append((shot, cell))
    over = "D₀" if is_radial(size) else "L₀"
    shown = []
    for (lot, shape), entries in panels.items():
        layers = _curve_layers(results, size, lot, shape, ratios)
        with_curve = bool(layers)
        for ratio in ratios:
            mine = [entry for entry in entries if _ratio(rows[entry[0]["id"]]) == ratio]
            layers += _shot_layers(mine, rows, size, ratio, ratios, with_curve)
        title = lot_words(lot) if len(results.lots) > 1 else shape_words(shape)
        if len(results.lots) > 1 and len({key[1] for key in panels if key[0] == lot}) > 1:
            title += f", {shape_words(shape)}"
        shown.append(Panel(layers, title, "velocity, m/s", f"{size_words(size)} / {over}"))
    return Chart(
        f"against_velocity_{size}",
        sentence_case(size_words(size)),
        "",
        shown,
        columns=min(3, max(len(shown), 2)),
        row_height=270,
        legend=len(ratios) > 1,
    )


def _curve_layers(results: Results, size: str, lot: str, shape: str, ratios: list) -> list:
    layers = []
    curves = [
        curve
        for curve in results.comparison["curves"]
        if (curve["size"], curve["lot"], curve["shape"]) == (size, lot, shape)
    ]
    for curve in curves:
        reference = size_before_impact(size, curve)
        position = _nearest(ratios, curve["initial_length_mm"] / curve["initial_diameter_mm"])
        colour = ordered_colour(position, len(ratios))
        scaled = {
            key: [value / reference for value in curve[key]]
            for key in ("lower", "upper", "predicted")
        }
        x = curve["velocity_m_s"]
        layers.append(Band(x, scaled["lower"], scaled["upper"], colour, 0.22 / len(curves) ** 0.5))
        layers.append(Line(x, scaled["predicted"], colour))
    return layers


def _nearest(values: list[float], wanted: float) -> int:
    return min(range(len(values)), key=lambda index: abs(values[index] - wanted))


def _shot_layers(entries, rows, size, ratio, ratios, with_curve) -> list:
    layers = []
    colour = ordered_colour(ratios.index(ratio), len(ratios))
    for use in ("calibrate", "validate"):
        mine = [(shot, cell) for shot, cell in entries if shot["use"] == use]
        if not mine:
            continue
        reference = [size_before_impact(size, rows[shot["id"]]) for shot, _ in mine]
        column = {
            key: [cell[key] / scale for (_, cell), scale in zip(mine, reference)]
            for key in ("measured", "sd", "predictive_lower", "predictive_upper")
        }
        x = [shot["velocity_m_s"] for shot, _ in mine]
        if not with_curve:
            ends = (column["predictive_lower"], column["predictive_upper"])
            layers.append(Intervals(x, *ends, colour))
        layers.append(
            Points(
                x,
                column["measured"],
                colour,
                y_error=column["sd"],
                labels=[_cell_label(shot, cell) for shot, cell in mine],
                legend=f"L/D {ratio:g}" if use == "calibrate" else "",
                legend_rank=ratios.index(ratio),
                size=6.5,
                **USE_SYMBOL[use],
            )
        )
    return layers


def _cell_label(shot: dict, cell: dict) -> str:
    return (
        f"<b>{shot['id']}</b> ({USE_WORDS[shot['use']]})<br>{shot['velocity_m_s']:g} m/s, "
        f"{size_words(cell['size'])}<br>measured {cell['measured']:.4g} ± {cell['sd']:.2g} mm<br>"
        f"model {cell['predicted']:.4g} mm "
        f"({cell['predictive_lower']:.4g} to {cell['predictive_upper']:.4g})"
    )


def parity_chart(results: Results) -> Chart:
    """Sizes over those before impact, so that specimens of all lengths share a scale."""
    key, words = grouping(results)
    names = list(dict.fromkeys(row[key] for row in results.used_rows))
    sizes: dict[str, list] = {}
    for shot in results.comparison["shots"]:
        for cell in shot["sizes"]:
            scale = size_before_impact(cell["size"], shot)
            sizes.setdefault(cell["size"], []).append((shot, cell, scale))
    return Chart(
        "measured_against_model",
        "Measured against model",
        "Sizes over the initial length L₀ or diameter D₀. The line is agreement. Filled marks are "
        "fitted, hollow ones held back; error bars are one standard error of the measurement.",
        [_parity_panel(size, entries, key, names, words) for size, entries in sizes.items()],
        columns=min(4, len(sizes)),
        row_height=290,
        legend=True,
    )


def _parity_panel(size: str, entries: list, key: str, names: list[str], words) -> Panel:
    values = [cell[of] / scale for _, cell, scale in entries for of in ("measured", "predicted")]
    margin = 0.05 * (max(values) - min(values))
    ends = [min(values) - margin, max(values) + margin]
    layers = [Line(ends, ends, "faint", width=1)]
    for use in ("calibrate", "validate"):
        for index, name in enumerate(names):
            mine = [entry for entry in entries if entry[0][key] == name and entry[0]["use"] == use]
            if mine:
                layers.append(
                    Points(
                        [cell["predicted"] / scale for _, cell, scale in mine],
                        [cell["measured"] / scale for _, cell, scale in mine],
                        PALETTE[index % len(PALETTE)],
                        y_error=[cell["sd"] / scale for _, cell, scale in mine],
                        labels=[_cell_label(shot, cell) for shot, cell, _ in mine],
                        legend=words(name) if use == "calibrate" else "",
                        legend_rank=index,
                        size=6,
                        **USE_SYMBOL[use],
                    )
                )
    over = "D₀" if is_radial(size) else "L₀"
    title = f"{size_words(size)} / {over}"
    layers.append(held_back_legend(len(names)))
    return Panel(layers, title, "model", "measured", x_range=tuple(ends))


def held_back_legend(rank: int) -> Points:
    """An entry for the hollow marks of all colours."""
    return Points([], [], "ink", legend=USE_WORDS["validate"], legend_rank=rank, hollow=True)
