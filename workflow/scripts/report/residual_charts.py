"""Where the model fails: deviations by shape, size, velocity and lot."""

from statistics import NormalDist, mean

from report.chart import PALETTE, Band, Cells, Chart, Line, Panel, Points
from report.model_charts import USE_SYMBOL, grouping, held_back_legend
from report.results import Results
from report.words import THIRDS, USE_WORDS, lot_words, relative_words, shape_words
from report.words import signed_percent, size_words, third_words
from size_kinds import OUTLINE_SCORES

FULL_COLOUR = 4.0  # mean deviation in standard errors that gets the full colour
BY_SHAPE_SIZE_THIRD = "shape x size x velocity_third"


def heat_map(comparison: dict) -> Chart:
    """A panel for each shape: sizes against thirds of the velocities.

    Of other groupings in comparison.json than shape x size x third nothing is shown.
    """
    found = {
        tuple(group["key"].split(" x ")): group
        for group in comparison["groups"]
        if group["by"] == BY_SHAPE_SIZE_THIRD
    }
    shapes = list(dict.fromkeys(shape for shape, _, _ in found))
    sizes = list(dict.fromkeys(size for _, size, _ in found))
    several = len(shapes) > 1
    by = "shape, size and velocity in m/s" if several else "size and velocity"
    thirds = [third for third in THIRDS if any(key[2] == third for key in found)]
    words = third_words(comparison["velocity_thirds_m_s"], narrow=several)
    panels = [
        _cell_panel(
            [size_words(size) for size in sizes],
            [words[third] for third in thirds],
            [[found.get((shape, size, third)) for third in thirds] for size in sizes],
            shape_words(shape) if several else "",
            several=several,
        )
        for shape in shapes
    ]
    return Chart(
        "residuals",
        f"Measured − model by {by}",
        f"Mean deviation of the measurement from the model, {relative_words(sizes)}, for each "
        "third of the velocities. Orange: measured larger than the model; blue: smaller. The "
        "colour is the mean of the whitened deviations: of what is left when each datum is divided "
        f"by its error and cleared of what the shot's other sizes say; full at {FULL_COLOUR:.0f}. "
        "Below: their root mean square in standard errors (s.e.; 1 is what the errors explain) and "
        "the number n of data.",
        panels,
        columns=max(len(panels), 1),
        row_height=54 + (58 if several else 46) * len(sizes),
        shared_rows=True,
    )


def lot_heat_map(results: Results) -> Chart:
    """The same by lot, which shows a lot that one parameter cannot satisfy."""
    cells: dict[tuple, list] = {}
    for shot in results.comparison["shots"]:
        for cell in shot["sizes"]:
            mine = {**cell, "relative": cell["residual"] / _reference(cell, shot)}
            cells.setdefault((shot["lot"], cell["size"]), []).append(mine)
    lots = list(dict.fromkeys(lot for lot, _ in cells))
    sizes = list(dict.fromkeys(size for _, size in cells))

    def summary(entries):
        if not entries:
            return None
        return {
            "n": len(entries),
            "mean_relative": mean(c["relative"] for c in entries),
            "mean_whitened": mean(c["whitened"] for c in entries),
            "whitened_rms": mean(c["whitened"] ** 2 for c in entries) ** 0.5,
        }

    panel = _cell_panel(
        [lot_words(lot) for lot in lots],
        [size_words(size) for size in sizes],
        [[summary(cells.get((lot, size))) for size in sizes] for lot in lots],
    )
    height = 40 + 46 * len(lots)
    title = "Measured − model by lot"
    return Chart("residuals_by_lot", title, "", [panel], columns=1, row_height=height)


def _reference(cell: dict, shot: dict) -> float:
    """What a deviation is relative to; of sizes that may vanish it is one before impact."""
    if cell["size"] in OUTLINE_SCORES:
        return shot["initial_diameter_mm"]
    if cell["size"] == "undeformed_length_mm":
        return shot["initial_length_mm"]
    return cell["measured"]


def _cell_panel(rows, columns, cells, title="", several=False) -> Panel:
    values = [[cell and cell["mean_whitened"] for cell in row] for row in cells]
    texts = [[_cell_text(cell, several) for cell in row] for row in cells]
    return Panel([Cells(rows, columns, values, texts, limit=FULL_COLOUR)], title)


def _cell_text(cell: dict | None, narrow: bool) -> str:
    if not cell:
        return ""
    rms, count = f"{cell['whitened_rms']:.1f} s.e.", f"n {cell['n']}"
    share = f"<b>{signed_percent(cell['mean_relative'])}</b>"
    return f"{share}<br>{rms}<br>{count}" if narrow else f"{share}<br>{rms}, {count}"


def scatter_chart(results: Results) -> Chart:
    """Every whitened deviation against velocity, a panel for each size."""
    key, words = grouping(results)
    names = list(dict.fromkeys(row[key] for row in results.used_rows))
    sizes: dict[str, list] = {}
    for shot in results.comparison["shots"]:
        for cell in shot["sizes"]:
            sizes.setdefault(cell["size"], []).append((shot, cell))
    panels = []
    for size, entries in sizes.items():
        velocities = [shot["velocity_m_s"] for shot, _ in entries]
        ends = [min(velocities), max(velocities)]
        layers = [Band(ends, [-2, -2], [2, 2], "#8a929b", 0.14), Line(ends, [0, 0], "faint")]
        for index, name in enumerate(names):
            for use, style in list(USE_SYMBOL.items())[:2]:
                mine = [(s, c) for s, c in entries if s[key] == name and s["use"] == use]
                if mine:
                    layers.append(
                        Points(
                            [shot["velocity_m_s"] for shot, _ in mine],
                            [cell["whitened"] for _, cell in mine],
                            PALETTE[index % len(PALETTE)],
                            labels=[_label(*entry) for entry in mine],
                            legend=words(name) if use == "calibrate" else "",
                            legend_rank=index,
                            size=6,
                            **style,
                        )
                    )
        layers.append(held_back_legend(len(names)))
        title = size_words(size)
        panels.append(Panel(layers, title, "velocity, m/s", "deviation, standard errors"))
    return Chart(
        "deviation_against_velocity",
        "Each deviation against velocity",
        "Measured minus model, whitened. Of a right model 95 % of the points lie in the grey band, "
        "without a slope or an arch. Filled marks are fitted, hollow ones held back.",
        panels,
        columns=min(3, max(len(panels), 2)),
        row_height=250,
        legend=len(names) > 1,
    )


def _label(shot: dict, cell: dict) -> str:
    return (
        f"<b>{shot['id']}</b> ({USE_WORDS[shot['use']]})<br>{shot['velocity_m_s']:g} m/s, "
        f"{cell['whitened']:+.1f} standard errors"
    )


def normal_chart(results: Results) -> Chart:
    """Whitened deviations against what a normal distribution would give."""
    panels = []
    for use in ("calibrate", "validate"):
        found = sorted(
            (cell["whitened"], f"<b>{shot['id']}</b><br>{size_words(cell['size'])}")
            for shot in results.comparison["shots"]
            for cell in shot["sizes"]
            if shot["use"] == use
        )
        if len(found) < 3:
            continue
        count = len(found)
        expected = [NormalDist().inv_cdf((index + 0.5) / count) for index in range(count)]
        ends = [expected[0], expected[-1]]
        points = Points(expected, [w for w, _ in found], labels=[label for _, label in found])
        points.size = 5
        points.hollow = use == "validate"
        x_label = "expected of a normal distribution"
        layers = [Line(ends, ends, "faint", width=1), points]
        panels.append(Panel(layers, USE_WORDS[use], x_label, "deviation, standard errors"))
    return Chart(
        "normal_plot",
        "Are the deviations as large as their errors say?",
        "Whitened deviations in order of size, against those of a normal distribution (normal "
        "quantile plot). Points on the line: yes. A steeper run means that the stated errors are "
        "too small or that the model misses something; single points off the line are odd data.",
        panels,
        columns=2,
        row_height=280,
    )
