"""Draws a chart as PNG with matplotlib, on white, for papers and slides."""

from pathlib import Path

import matplotlib
from matplotlib.colors import LinearSegmentedColormap, Normalize, to_rgba
from matplotlib.figure import Figure

from report.chart import Bars, Band, Cells, Chart, Histogram, Intervals, Line, Map, Panel
from report.chart import Points, Spans

THEME = {"ink": "#1f2328", "soft": "#5c646d", "faint": "#9aa1a9", "grid": "#e8eaed"}
SYMBOLS = {"circle": "o", "cross": "x", "star": "*", "diamond": "D"}
WIDTH_INCHES, PIXELS_PER_INCH = 10.4, 96
LETTERS_A_LINE, LINE_INCHES = 160, 0.25
STYLE = {
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": THEME["faint"],
    "axes.grid": True,
    "grid.color": THEME["grid"],
    "legend.frameon": False,
    "svg.hashsalt": "taylorcal",
}


def save_png(chart: Chart, folder: Path, mark: str = "") -> None:
    """`mark` stands behind the title: what a reader of the picture alone must know."""
    with matplotlib.rc_context(STYLE):
        height = chart.rows * chart.row_height / PIXELS_PER_INCH + 0.5
        figure = Figure(figsize=(WIDTH_INCHES, height), layout="constrained")
        title = chart.title + mark
        figure.suptitle(title, x=0.01, ha="left", weight="bold", size=11)
        grid = figure.subplots(chart.rows, chart.columns, squeeze=False).ravel()
        for axes in grid[len(chart.panels) :]:
            axes.set_axis_off()
        for index, (axes, panel) in enumerate(zip(grid, chart.panels)):
            _draw(axes, panel)
            if chart.shared_rows and index % chart.columns:
                axes.tick_params(labelleft=False)
        if chart.legend:
            _legend(figure, grid, chart, title)
        figure.savefig(folder / f"{chart.name}.png", dpi=150, metadata={"Software": None})


def _legend(figure, grid, chart: Chart, title: str) -> None:
    """Beside the title, or on a line of its own below it where both would not fit."""
    entries = {}
    for axes in grid:
        handles, names = axes.get_legend_handles_labels()
        entries |= dict(zip(names, handles))
    ranks = {
        layer.legend: layer.legend_rank
        for panel in chart.panels
        for layer in panel.layers
        if isinstance(layer, Points)
    }
    entries = dict(sorted(entries.items(), key=lambda entry: ranks.get(entry[0], 0)))
    if not entries:
        return
    top = 1
    letters = len(title) * 1.38 + sum(len(name) + 8 for name in entries)
    if letters > LETTERS_A_LINE:
        height = figure.get_figheight() + LINE_INCHES
        figure.set_figheight(height)
        top = 1 - LINE_INCHES / height
        figure.get_layout_engine().set(rect=(0, 0, 1, top))
    place = {"loc": "upper right", "bbox_to_anchor": (1, top), "ncols": min(len(entries), 9)}
    figure.legend(entries.values(), entries.keys(), fontsize=8, **place)


def _draw(axes, panel: Panel) -> None:
    axes.set_title(panel.title.replace("<br>", "\n"))
    axes.set_xlabel(panel.x_label)
    axes.set_ylabel(panel.y_label)
    axes.set_axisbelow(True)
    for layer in panel.layers:
        _DRAWERS[type(layer)](axes, layer)
    if panel.x_log:
        axes.set_xscale("log")
    if panel.y_log:
        axes.set_yscale("log")
    if panel.x_range:
        axes.set_xlim(panel.x_range)
    if panel.y_range:
        axes.set_ylim(panel.y_range)
    if panel.y_ticks:
        axes.set_yticks(range(len(panel.y_ticks)), panel.y_ticks)
        axes.set_ylim(len(panel.y_ticks) - 0.5, -0.5)
    if panel.x_ticks:
        axes.set_xticks(range(len(panel.x_ticks)), panel.x_ticks)
        axes.set_xlim(-0.3, len(panel.x_ticks) - 0.7)
    if panel.hide_y:
        axes.set_yticks([])


def _colour(name: str) -> str:
    return THEME.get(name, name)


def _points(axes, layer: Points) -> None:
    colour = _colour(layer.colour)
    style = {"marker": SYMBOLS[layer.symbol], "linestyle": "none", "markersize": layer.size * 0.75}
    face = "white" if layer.hollow else colour
    axes.errorbar(
        layer.x,
        layer.y,
        yerr=layer.y_error,
        color=colour,
        markerfacecolor=face,
        elinewidth=0.9,
        label=layer.legend or None,
        zorder=3,
        **style,
    )
    for x, y, text in zip(layer.x, layer.y, layer.texts or []):
        axes.annotate(text, (x, y), xytext=(4, 3), textcoords="offset points")


def _line(axes, layer: Line) -> None:
    style = ":" if layer.dashed else "-"
    colour = _colour(layer.colour)
    axes.plot(layer.x, layer.y, style, color=colour, lw=layer.width, label=layer.legend or None)
    if layer.filled:
        axes.fill_between(layer.x, layer.y, color=colour, alpha=0.13, lw=0)


def _band(axes, layer: Band) -> None:
    axes.fill_between(layer.x, layer.low, layer.high, color=layer.colour, alpha=layer.opacity, lw=0)


def _intervals(axes, layer: Intervals) -> None:
    axes.vlines(layer.x, layer.low, layer.high, color=layer.colour, alpha=0.3, lw=5)


def _spans(axes, layer: Spans) -> None:
    axes.hlines(
        layer.y,
        layer.low,
        layer.high,
        color=_colour(layer.colour),
        alpha=layer.opacity,
        lw=layer.width * 0.75,
        label=layer.legend or None,
        zorder=2,
    )


def _bars(axes, layer: Bars) -> None:
    bars = axes.barh(layer.names, layer.values, color=layer.colour, height=0.6)
    axes.bar_label(bars, layer.texts, padding=3)
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    axes.margins(x=0.2)


def _histogram(axes, layer: Histogram) -> None:
    axes.stairs(layer.counts, layer.edges, fill=True, color=layer.colour)


def _map(axes, layer: Map) -> None:
    shades = LinearSegmentedColormap.from_list("", ["#ffffff", layer.colour])
    columns = [list(row) for row in zip(*layer.density)]
    axes.pcolormesh(layer.x_edges, layer.y_edges, columns, cmap=shades, rasterized=True)


def _cells(axes, layer: Cells) -> None:
    shades = LinearSegmentedColormap.from_list("", ["#6198da", "#ffffff", "#e08d4f"])
    norm = Normalize(-layer.limit, layer.limit)
    for row, (values, texts) in enumerate(zip(layer.values, layer.texts, strict=True)):
        for column, (value, text) in enumerate(zip(values, texts, strict=True)):
            face = "#f4f5f6" if value is None else to_rgba(shades(norm(value)))
            box = (column - 0.48, row - 0.46)
            axes.add_patch(matplotlib.patches.Rectangle(box, 0.96, 0.92, facecolor=face))
            plain = text.replace("<br>", "\n").replace("<b>", "").replace("</b>", "")
            axes.text(column, row, plain, ha="center", va="center", size=8)
    axes.set_xticks(range(len(layer.columns)), layer.columns)
    axes.set_yticks(range(len(layer.rows)), layer.rows)
    axes.set_xlim(-0.5, len(layer.columns) - 0.5)
    axes.set_ylim(len(layer.rows) - 0.5, -0.5)
    axes.grid(False)
    axes.tick_params(length=0, top=True, labeltop=True, bottom=False, labelbottom=False)
    axes.spines[:].set_visible(False)


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
