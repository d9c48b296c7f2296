"""What the data say of the parameters."""

import numpy as np

from report.chart import PALETTE, Chart, Line, Map, Panel, Points
from report.results import Results
from report.words import UNIT_WORDS, lot_words, parameter_words, split_name

MOST_MAPS = 6


def _unit(results: Results, base: str) -> str:
    unit = results.settings["parameters"].get(base, {}).get("unit", "none")
    unit = UNIT_WORDS.get(unit, unit)
    return f", {unit}" if unit else ""


def _is_log(results: Results, base: str) -> bool:
    return results.settings["parameters"].get(base, {}).get("prior") == "log_uniform"


def _range(results: Results, base: str) -> tuple[float, float] | None:
    parameter = results.settings["parameters"].get(base)
    return (parameter["lower"], parameter["upper"]) if parameter else None


def marginal_chart(results: Results) -> Chart:
    """One panel a parameter; lots share a panel. Each curve has the same height."""
    panels: dict[str, Panel] = {}
    for name in results.posterior.names:
        base, lot = split_name(name)
        if name not in results.posterior.maps_1d:
            continue
        edges, density = results.posterior.maps_1d[name]
        log = _is_log(results, base)
        middles = np.sqrt(edges[1:] * edges[:-1]) if log else (edges[1:] + edges[:-1]) / 2
        height = density / (density.max() or 1)
        if base not in panels:
            panels[base] = _marginal_panel(results, base)
            panels[base].layers += _prior_lines(results, base, edges, density)
        panel = panels[base]
        colour = PALETTE[results.lots.index(lot) % len(PALETTE)] if lot else PALETTE[0]
        words = lot_words(lot) if lot else ""
        panel.layers.append(Line(list(middles), list(height), colour, filled=True, legend=words))
    return Chart(
        "posterior_marginals",
        "Each parameter by itself",
        "Probability density after the fit, scaled to one height, and before it (dotted: the "
        "prior, to the scale of the first curve). The axis of a calibrated parameter spans its "
        "whole prior range, so a narrow peak is what the data taught.",
        list(panels.values()),
        columns=2,
        row_height=250,
        legend=True,
    )


def _prior_lines(results: Results, base: str, edges, density) -> list[Line]:
    """The prior at the height that makes its area that of the posterior."""
    parameter = results.settings["parameters"].get(base)
    if parameter is None:
        return []
    scale = np.log10 if _is_log(results, base) else np.asarray
    place = np.linspace(*scale([parameter["lower"], parameter["upper"]]), 101)
    # An effect's amplitude has a normal prior around its absence; the others are flat.
    normal = parameter["prior"] in ("normal", "half_normal")
    shape = np.exp(-0.5 * (place / parameter["scale"]) ** 2) if normal else np.ones_like(place)
    area = np.sum(density * np.diff(scale(edges))) / (density.max() or 1)
    shape *= area / np.trapz(shape, place)
    x = 10 ** place if _is_log(results, base) else place
    return [Line(list(x), list(shape), "soft", dashed=True, legend="prior")]


def _marginal_panel(results: Results, base: str) -> Panel:
    label = parameter_words(base) + _unit(results, base)
    return Panel(
        [],
        x_label=label,
        x_log=_is_log(results, base),
        x_range=_range(results, base),
        y_range=(0, 1.08),
        hide_y=True,
    )


def map_chart(results: Results) -> Chart:
    """Pairs of parameters; of the lots only the one with the most fitted shots."""
    fitted = [row["lot"] for row in results.rows if row["use"] == "calibrate"]
    lot = max(results.lots, key=fitted.count)
    names = results.posterior.names
    panels = []
    for (first, second), (x_edges, y_edges, density) in results.posterior.maps_2d.items():
        bases = [split_name(first), split_name(second)]
        if any(found not in ("", lot) for _, found in bases):
            continue
        if any(base not in results.settings["parameters"] for base, _ in bases):
            continue
        maxima = results.posterior.maxima[:, [names.index(first), names.index(second)]]
        numbers = [str(index + 1) for index in range(len(maxima))]
        marks = Points(
            list(maxima[:, 0]),
            list(maxima[:, 1]),
            "ink",
            symbol="star",
            size=9,
            texts=numbers if len(maxima) > 1 else None,
        )
        panels.append(
            Panel(
                [Map(list(x_edges), list(y_edges), density.tolist()), marks],
                x_label=parameter_words(first) + _unit(results, bases[0][0]),
                y_label=parameter_words(second) + _unit(results, bases[1][0]),
                x_log=_is_log(results, bases[0][0]),
                y_log=_is_log(results, bases[1][0]),
            )
        )
    of_lot = f" Of the lots, {lot_words(lot)} is shown." if len(results.lots) > 1 else ""
    return Chart(
        "posterior_maps",
        "Parameters in pairs",
        "Probability density of two parameters at a time; stars mark the maxima. A slanted ridge "
        f"means that one can be traded for the other.{of_lot}",
        panels[:MOST_MAPS],
        columns=min(3, max(len(panels), 2)),
        row_height=310,
    )
