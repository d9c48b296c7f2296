"""Pictures of a diagnosis: what each candidate gains, and what could have been seen."""

from report.candidates import largest_physical, unit_words
from report.chart import PALETTE, Cells, Chart, Line, Panel, Points, Spans
from report.diagnosis_results import DiagnosisResults
from report.residual_charts import FULL_COLOUR
from report.words import THIRDS, effect_words, sentence_case, shape_words, size_words

MOST_IN_MATRIX = 14
CLEAR_GAIN = 3.0  # of ln Z, twenty to one
CHOSEN, OTHER = PALETTE[1], "#9aa6b4"


def evidence_chart(results: DiagnosisResults) -> Chart:
    """ln Z gain of each candidate, and between which values half and double width put it."""
    ranked = [entry for entry in results.ranked if not entry["abstain"]]
    rows = list(range(len(ranked)))
    layers = []
    others = "others" if any(entry["in_set"] for entry in ranked) else "candidates"
    kinds = (("in the set of the verdict", CHOSEN, True), (others, OTHER, False))
    for words, colour, chosen in kinds:
        mine = [row for row in rows if ranked[row]["in_set"] == chosen]
        if mine:
            gains = [ranked[row]["log_evidence_gain"] for row in mine]
            labels = [
                f"{effect_words(ranked[row]['name'])}: {g:+.1f}" for row, g in zip(mine, gains)
            ]
            layers.append(
                Spans(mine, [0] * len(mine), gains, colour, 13, labels=labels, legend=words)
            )
    widths = [
        sorted(
            entry[key]
            for key in (
                "log_evidence_gain",
                "log_evidence_gain_half_width",
                "log_evidence_gain_double_width",
            )
        )
        for entry in ranked
    ]
    lows, highs = [width[0] for width in widths], [width[-1] for width in widths]
    layers.append(Spans(rows, lows, highs, "ink", 2.5, legend="prior half or twice as wide"))
    height = [-0.5, len(rows) - 0.5]
    layers.append(Line([0, 0], height, "faint", width=1))
    layers.append(Line([CLEAR_GAIN] * 2, height, "soft", dashed=True, legend="20 to 1"))
    names = [sentence_case(effect_words(entry["name"])) for entry in ranked]
    ends = min([0.0, *lows]), max([CLEAR_GAIN, *highs])
    room = 0.03 * (ends[1] - ends[0])
    limits = (ends[0] - room, ends[1] + room)
    return Chart(
        "evidence_gain",
        "What each candidate gains",
        "Gain of ln Z, the logarithm of how probable the data are, when the candidate is added. "
        "Its range of possible amplitudes counts against it, so that an idle effect loses. "
        "A gain of 3 means 20 to 1, of 5 means 150 to 1; candidates within 3 of the best stay in "
        "the set. Thin bars: the same with the prior of its amplitude half and twice as wide. "
        "Candidates that the parameters can imitate are not shown.",
        [Panel(layers, x_label="gain of ln Z", y_ticks=names, x_range=limits)] if rows else [],
        columns=1,
        row_height=90 + 25 * len(rows),
        legend=True,
    )


def confounding_chart(results: DiagnosisResults) -> Chart:
    """Cosines between the signatures, of the best candidates and those in the set."""
    names, cosine = (results.diagnosis["confounding"][key] for key in ("names", "cosine"))
    order = [entry["name"] for entry in results.ranked if entry["name"] in names]
    chosen = [names.index(name) for name in order[:MOST_IN_MATRIX]]
    values = [[cosine[i][j] for j in chosen] for i in chosen]
    texts = [
        ["" if i == j else f"{value:.2f}".replace("-", "−") for j, value in enumerate(row)]
        for i, row in enumerate(values)
    ]
    for place in range(len(chosen)):
        values[place][place] = None
    rows = [f"{place + 1}  {effect_words(names[i])}" for place, i in enumerate(chosen)]
    columns = [str(place + 1) for place in range(len(chosen))]
    return Chart(
        "confounding",
        "Which candidates look alike",
        "Likeness (cosine) of what two candidates do to these shots, once the parameters are free "
        "to follow. Near 1 or −1: these shots cannot tell them apart, and beyond 0.9 they are "
        "always named together. Near 0: they are told apart. Columns are numbered as the rows.",
        [Panel([Cells(rows, columns, values, texts, limit=1)])] if len(chosen) > 1 else [],
        columns=1,
        row_height=44 + 27 * len(rows),
    )


def unseen_chart(results: DiagnosisResults) -> Chart:
    """Amplitudes on the scale of their physical range: hidden, visible, and estimated."""
    entries = [
        entry
        for entry in results.ranked
        if largest_physical(entry) and entry["smallest_detectable"] is not None
    ]
    rows = list(range(len(entries)))
    shares = [100 * entry["smallest_detectable"] / largest_physical(entry) for entry in entries]
    hidden = [
        100.0 if entry["abstain"] else min(share, 100.0) for entry, share in zip(entries, shares)
    ]
    signed = [entry.get("signed", False) for entry in entries]
    backs = [-100.0 if s else 0.0 for s in signed]
    layers = [
        Spans(rows, backs, [100.0] * len(rows), "#8fbf9f", 15, 0.55, legend="would have been seen"),
        Spans(
            rows,
            [-limit if s else 0.0 for limit, s in zip(hidden, signed)],
            hidden,
            "#8a929b",
            15,
            legend="would not have been seen",
        ),
    ]
    shown = [row for row in rows if entries[row]["amplitude"] is not None]
    shown = [row for row in shown if not entries[row]["abstain"]]
    share_of = {
        key: [
            max(-100.0, min(100.0, 100 * entries[row][key] / largest_physical(entries[row])))
            for row in shown
        ]
        for key in ("lower95", "amplitude", "upper95")
    }
    labels = [_amplitude_label(entries[row]) for row in shown]
    layers.append(Spans(shown, share_of["lower95"], share_of["upper95"], "ink", 2.5))
    layers.append(
        Points(share_of["amplitude"], shown, "ink", labels=labels, legend="estimate, 95 % interval")
    )
    names = [sentence_case(effect_words(entry["name"])) for entry in entries]
    axis = "amplitude, per cent of the largest that is physical"
    limits = (-103.0 if any(signed) else -2.0, 103.0)
    return Chart(
        "smallest_detectable",
        "Amplitudes that these shots show, and that they miss",
        "Each row spans the physical range of a candidate's amplitude. Grey: so small that these "
        "shots would miss it more often than once in ten. Green: large enough to be found. An "
        "estimate is cut off at the ends of the range; without one, parameters imitate the effect.",
        [Panel(layers, x_label=axis, y_ticks=names, x_range=limits)] if entries else [],
        columns=1,
        row_height=90 + 25 * len(rows),
        legend=True,
    )


def _amplitude_label(entry: dict) -> str:
    unit = unit_words(entry)
    return (
        f"<b>{effect_words(entry['name'])}</b><br>{entry['amplitude']:.3g} {unit} "
        f"({entry['lower95']:.3g} to {entry['upper95']:.3g})<br>"
        f"seen from {entry['smallest_detectable']:.3g} {unit}"
    )


def pattern_chart(results: DiagnosisResults) -> Chart:
    """What no change of the parameters takes away: shape x size x velocity third."""
    pattern = results.diagnosis["unexplained"]["pattern"]
    found = {(cell["shape"], cell["size"], cell["velocity_third"]): cell for cell in pattern}
    shapes = list(dict.fromkeys(shape for shape, _, _ in found))
    sizes = list(dict.fromkeys(size for _, size, _ in found))
    panels = []
    for shape in shapes:
        cells = [[found.get((shape, size, third)) for third in THIRDS] for size in sizes]
        values = [[cell and cell["mean_whitened"] for cell in row] for row in cells]
        texts = [
            [
                f"<b>{cell['mean_whitened']:+.1f}</b>, n {cell['n']}".replace("-", "−")
                if cell
                else ""
                for cell in row
            ]
            for row in cells
        ]
        layer = Cells(
            [size_words(size) for size in sizes],
            ["slow", "middle", "fast"],
            values,
            texts,
            FULL_COLOUR,
        )
        panels.append(Panel([layer], shape_words(shape) if len(shapes) > 1 else ""))
    return Chart(
        "unexplained_pattern",
        "What is left of measured − model",
        "Mean whitened deviation for each third of the velocities (slow, middle, fast), after the "
        "parameters have taken what they can. Orange: measured larger than the model; blue: "
        "smaller. A mean of n data scatters by 1/√n if nothing is missing.",
        panels,
        columns=max(len(panels), 1),
        row_height=54 + 34 * len(sizes),
        shared_rows=True,
    )
