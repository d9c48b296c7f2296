"""Draws a chart with plotly: figure JSON whose "var:" colours the page fills in."""

import json
from math import log10

from report.chart import Bars, Band, Cells, Chart, Histogram, Intervals, Line, Map, Panel
from report.chart import Points, Spans, tidy

GAP_X, GAP_TOP, GAP_BOTTOM = 0.075, 30, 54  # share of the width, and px round a panel
NARROW_GAP_X, LETTER = 0.015, 0.0066  # share of the width: between alike panels, of a letter
LEGEND_PX = 34
SYMBOLS = {"circle": "circle", "cross": "x-thin", "star": "star", "diamond": "diamond"}


def plotly_json(chart: Chart) -> str:
    """{"data": [...], "layout": {...}}; plotly.js itself is on the page once."""
    top = LEGEND_PX if chart.legend else 0
    height = chart.rows * chart.row_height + top
    layout = {
        "height": height,
        "margin": {"l": 0, "r": 8, "t": 0, "b": 0},
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        "font": {"family": "var:sans", "size": 12, "color": "var:ink"},
        "showlegend": chart.legend,
        "legend": {"orientation": "h", "x": 0, "y": 1, "yanchor": "top", "traceorder": "normal"},
        "hoverlabel": {"font": {"family": "var:sans"}},
        "annotations": [],
        "bargap": 0.35,
    }
    traces, seen = [], set()
    for index, panel in enumerate(chart.panels):
        suffix = "" if index == 0 else str(index + 1)
        domain = _domain(chart, index, height, top)
        layout["xaxis" + suffix], layout["yaxis" + suffix] = _axes(panel, domain, suffix)
        if chart.shared_rows and index % chart.columns:
            layout["yaxis" + suffix]["showticklabels"] = False
        if panel.title:
            above = 24 if _has(panel, Cells) else 8  # names of columns stand above the cells
            layout["annotations"].append(_heading(panel.title, domain, above / height))
        for layer in panel.layers:
            for trace in _DRAWERS[type(layer)](layer):
                legend = trace.get("name", "")
                trace["showlegend"] = bool(legend) and legend not in seen
                seen.add(legend)
                traces.append({**trace, "xaxis": "x" + suffix, "yaxis": "y" + suffix})
            if isinstance(layer, Cells):
                layout["annotations"] += _cell_texts(layer, suffix)
    return json.dumps({"data": traces, "layout": layout}, separators=(",", ":"))


def _domain(chart: Chart, index: int, height: float, top: float) -> tuple[list, list]:
    row, column = divmod(index, chart.columns)
    left = max(GAP_X * (1.9 if _wide_labels(chart) else 1), LETTER * _longest_name(chart))
    gap = NARROW_GAP_X if chart.shared_rows else GAP_X
    width = (1 - (chart.columns - 1) * gap - left) / chart.columns
    x = left + column * (width + gap)
    labelled = any(panel.x_label for panel in chart.panels)
    titled_cells = any(panel.title and _has(panel, Cells) for panel in chart.panels)
    gap_top = GAP_TOP + (16 if titled_cells else 0)
    panel_top = height - top - row * chart.row_height - gap_top
    gap_bottom = GAP_BOTTOM if labelled else 8
    panel_bottom = height - top - (row + 1) * chart.row_height + gap_bottom
    return [x, x + width], [panel_bottom / height, panel_top / height]


def _wide_labels(chart: Chart) -> bool:
    return any(panel.y_ticks or _has(panel, (Cells, Bars)) for panel in chart.panels)


def _longest_name(chart: Chart) -> int:
    """Letters of the longest name beside the rows of a panel."""
    names = [name for panel in chart.panels for name in panel.y_ticks or []]
    cells = [layer for panel in chart.panels for layer in panel.layers if isinstance(layer, Cells)]
    return max((len(name) for name in (*names, *(n for c in cells for n in c.rows))), default=0)


def _has(panel: Panel, kinds) -> bool:
    return any(isinstance(layer, kinds) for layer in panel.layers)


def _axes(panel: Panel, domain: tuple, suffix: str) -> tuple[dict, dict]:
    def axis(label, logarithmic, limits):
        shown = {"title": {"text": label, "standoff": 6, "font": {"size": 12}}} if label else {}
        if limits:
            shown["range"] = list(limits)
        if logarithmic:
            shown["type"] = "log"
            if limits:
                ends = [log10(limit) for limit in limits]
                shown |= {"range": ends, "dtick": 1, "exponentformat": "power"}
            else:
                shown |= {"tickformat": "~e", "nticks": 4}
        return {
            "gridcolor": "var:grid",
            "zeroline": False,
            "linecolor": "var:faint",
            "tickcolor": "var:faint",
            "ticks": "outside",
            "ticklen": 3,
            "tickfont": {"size": 11, "color": "var:soft"},
            "nticks": 6,
        } | shown

    x = axis(panel.x_label, panel.x_log, panel.x_range)
    y = axis(panel.y_label, panel.y_log, panel.y_range)
    x |= {"domain": domain[0], "anchor": "y" + suffix, "showline": True}
    y |= {"domain": domain[1], "anchor": "x" + suffix}
    if panel.y_ticks:
        y |= {"tickvals": list(range(len(panel.y_ticks))), "ticktext": panel.y_ticks, "ticks": ""}
        y["range"] = [len(panel.y_ticks) - 0.5, -0.5]
    if panel.x_ticks:
        x |= {"tickvals": list(range(len(panel.x_ticks))), "ticktext": panel.x_ticks}
        x["range"] = [-0.3, len(panel.x_ticks) - 0.7]
    if panel.hide_y:
        y |= {"showticklabels": False, "ticks": "", "showgrid": False}
    names = {"autorange": "reversed", "showgrid": False, "ticks": "", "dtick": 1}
    if _has(panel, Cells):
        y |= {**names, "type": "category", "showline": False}
        x |= {
            "type": "category",
            "showgrid": False,
            "ticks": "",
            "side": "top",
            "showline": False,
            "dtick": 1,
        }
    if _has(panel, Bars):
        y |= names
    return x, y


def _heading(text: str, domain: tuple, above: float) -> dict:
    return {
        "text": f"<b>{text}</b>",
        "x": domain[0][0],
        "y": domain[1][1] + above,
        "xref": "paper",
        "yref": "paper",
        "xanchor": "left",
        "yanchor": "bottom",
        "showarrow": False,
        "font": {"size": 12},
    }


def _rounded(values) -> list:
    return [tidy(value) for value in values]


def _shade(colour: str, opacity: float) -> str:
    red, green, blue = (int(colour[start : start + 2], 16) for start in (1, 3, 5))
    return f"rgba({red},{green},{blue},{opacity})"


def _themed(colour: str) -> str:
    return colour if colour.startswith("#") else f"var:{colour}"


def _points(layer: Points) -> list[dict]:
    colour = _themed(layer.colour)
    marker = {"size": layer.size, "color": colour, "symbol": SYMBOLS[layer.symbol]}
    if layer.hollow:
        marker["color"] = "var:paper"
    if layer.hollow or layer.symbol == "cross":
        marker["line"] = {"color": colour, "width": 1.6}
    trace = {
        "type": "scatter",
        "mode": "markers+text" if layer.texts else "markers",
        "x": _rounded(layer.x),
        "y": _rounded(layer.y),
        "marker": marker,
        "name": layer.legend,
        "legendrank": layer.legend_rank,
        "hovertemplate": "%{x}, %{y}<extra></extra>",
    }
    if layer.labels:
        trace |= {"text": layer.labels, "hovertemplate": "%{text}<extra></extra>"}
    if layer.texts:
        trace |= {"text": layer.texts, "textposition": "top right", "cliponaxis": False}
    if layer.y_error:
        bars = {"type": "data", "array": _rounded(layer.y_error), "width": 0, "thickness": 1.2}
        trace["error_y"] = bars | {"color": colour}
    return [trace]


def _line(layer: Line) -> list[dict]:
    trace = {
        "type": "scatter",
        "mode": "lines",
        "x": _rounded(layer.x),
        "y": _rounded(layer.y),
        "line": {
            "color": _themed(layer.colour),
            "width": layer.width,
            "dash": "dot" if layer.dashed else "solid",
        },
        "name": layer.legend,
        "hoverinfo": "skip",
    }
    if layer.filled:
        trace |= {"fill": "tozeroy", "fillcolor": _shade(layer.colour, 0.13)}
    return [trace]


def _band(layer: Band) -> list[dict]:
    edge = {"type": "scatter", "mode": "lines", "line": {"width": 0}, "hoverinfo": "skip"}
    low = edge | {"x": _rounded(layer.x), "y": _rounded(layer.low)}
    high = edge | {"x": _rounded(layer.x), "y": _rounded(layer.high)}
    return [low, high | {"fill": "tonexty", "fillcolor": _shade(layer.colour, layer.opacity)}]


def _intervals(layer: Intervals) -> list[dict]:
    x, y = [], []
    for at, low, high in zip(layer.x, layer.low, layer.high, strict=True):
        x += [tidy(at), tidy(at), None]
        y += [tidy(low), tidy(high), None]
    line = {"color": _shade(layer.colour, 0.3), "width": 7}
    return [{"type": "scatter", "mode": "lines", "x": x, "y": y, "line": line, "hoverinfo": "skip"}]


def _spans(layer: Spans) -> list[dict]:
    x, y, labels = [], [], []
    for at, low, high, label in zip(
        layer.y, layer.low, layer.high, layer.labels or [""] * len(layer.y), strict=True
    ):
        x += [tidy(low), tidy(high), None]
        y += [at, at, None]
        labels += [label, label, ""]
    colour = _themed(layer.colour)
    trace = {
        "type": "scatter",
        "mode": "lines",
        "x": x,
        "y": y,
        "line": {"color": colour, "width": layer.width},
        "opacity": layer.opacity,
        "name": layer.legend,
        "hoverinfo": "skip",
    }
    if layer.labels:
        trace |= {"text": labels, "hoverinfo": "text"}
    return [trace]


def _bars(layer: Bars) -> list[dict]:
    return [
        {
            "type": "bar",
            "orientation": "h",
            "y": layer.names,
            "x": _rounded(layer.values),
            "text": layer.texts,
            "textposition": "outside",
            "cliponaxis": False,
            "marker": {"color": layer.colour},
            "hoverinfo": "skip",
        }
    ]


def _histogram(layer: Histogram) -> list[dict]:
    middles = [(a + b) / 2 for a, b in zip(layer.edges, layer.edges[1:])]
    widths = [0.94 * (b - a) for a, b in zip(layer.edges, layer.edges[1:])]
    return [
        {
            "type": "bar",
            "x": _rounded(middles),
            "y": _rounded(layer.counts),
            "width": _rounded(widths),
            "marker": {"color": layer.colour},
            "hovertemplate": "%{y} near %{x}<extra></extra>",
        }
    ]


def _map(layer: Map) -> list[dict]:
    largest = max(max(column) for column in layer.density) or 1
    share = [
        [tidy(layer.density[i][j] / largest) for i in range(len(layer.density))]
        for j in range(len(layer.density[0]))
    ]
    return [
        {
            "type": "heatmap",
            "x": _rounded(layer.x_edges),
            "y": _rounded(layer.y_edges),
            "z": share,
            "colorscale": [[0, _shade(layer.colour, 0)], [1, _shade(layer.colour, 1)]],
            "showscale": False,
            "hoverinfo": "skip",
        }
    ]


def _cells(layer: Cells) -> list[dict]:
    low, high = "#3f7fd0", "#d9772f"
    scale = [[0, _shade(low, 0.85)], [0.5, _shade(low, 0)], [0.5, _shade(high, 0)]]
    return [
        {
            "type": "heatmap",
            "x": layer.columns,
            "y": layer.rows,
            "z": [[tidy(value) for value in row] for row in layer.values],
            "zmin": -layer.limit,
            "zmax": layer.limit,
            "colorscale": [*scale, [1, _shade(high, 0.85)]],
            "showscale": False,
            "xgap": 3,
            "ygap": 3,
            "hoverinfo": "skip",
        }
    ]


def _cell_texts(layer: Cells, suffix: str) -> list[dict]:
    return [
        {
            "text": text,
            "x": column,
            "y": row,
            "xref": "x" + suffix,
            "yref": "y" + suffix,
            "showarrow": False,
            "font": {"size": 11.5, "color": "var:ink"},
        }
        for row, texts in enumerate(layer.texts)
        for column, text in enumerate(texts)
        if text
    ]


_DRAWERS = {
    Points: _points,
    Line: _line,
    Band: _band,
    Intervals: _intervals,
    Spans: _spans,
    Bars: _bars,
    Histogram: _histogram,
    Map: _map,
    Cells: _cells,
}
