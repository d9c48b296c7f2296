"""What a reader takes home, in sentences and short tables."""

import math

from statistics import median

from markupsafe import Markup, escape

from misfit_by_size import misfit_by_size
from report.results import Results
from report.words import PARAMETER_SYMBOLS, UNIT_WORDS, shape_words
from report.words import counted, listed, lot_words
from report.words import number, parameter_words, percent, size_words, split_name

ODD_DATUM = 3.0  # standard errors from which a single datum is listed
NEAR_END = 0.02  # share of the prior range within which an interval is open to that side
STEERING = 0.5  # posterior standard deviations from which a shot is said to steer the result


def parameter_rows(results: Results) -> list[dict]:
    """Best value, median and interval, and where the interval lies in the prior's range."""
    rows = []
    for entry in results.comparison["parameters"]:
        base, _ = split_name(entry["name"])
        prior = results.settings["parameters"].get(base)
        row = {
            "words": parameter_words(entry["name"]),
            "symbol": Markup(PARAMETER_SYMBOLS.get(base, "")),
            "unit": _unit(prior),
            "best": number(entry["maximum"]),
            "median": number(entry["median"]),
            "interval": _interval(entry),
            "bar": None,
        }
        if prior:
            row["prior"] = Markup(f"{number(prior['lower'], 2)} to {number(prior['upper'], 2)}")
            keys = ("lower95", "median", "upper95")
            row["bar"] = [100 * _position(entry[key], prior) for key in keys]
        rows.append(row)
    return rows


def _unit(prior: dict | None) -> str:
    if prior is None:
        return "relative"
    return UNIT_WORDS.get(prior["unit"], prior["unit"])


def _interval(entry: dict) -> Markup:
    return Markup(f"{number(entry['lower95'])} to {number(entry['upper95'])}")


def _position(value: float, prior: dict) -> float:
    scale = math.log10 if prior["prior"] == "log_uniform" else float
    lower, upper = scale(prior["lower"]), scale(prior["upper"])
    return min(max((scale(value) - lower) / (upper - lower), 0), 1)


def headline(results: Results) -> list[Markup]:
    """The result in a few sentences: parameters, misfit, where it fails."""
    sentences = [_parameter_sentence(results)]
    sentences += [_misfit_sentence(results, use) for use in ("calibrate", "validate")]
    sentences += [_failure_sentence(results), _bound_sentence(results), _network_sentence(results)]
    return [sentence for sentence in sentences if sentence]


def _parameter_sentence(results: Results) -> Markup:
    shared, by_base = [], {}
    for entry in results.comparison["parameters"]:
        base, lot = split_name(entry["name"])
        if base not in results.settings["parameters"]:
            continue
        if lot:
            by_base.setdefault(base, []).append((entry["median"], lot))
            continue
        unit = _unit(results.settings["parameters"][base])
        value = f"<b>{number(entry['median'])}</b> {unit}".rstrip()
        shared.append(f"{parameter_words(base)} {value} (95 % interval {_interval(entry)})")
    text = f"The data give the {listed(shared)}." if shared else ""
    for base, values in by_base.items():
        (low, low_lot), (high, high_lot) = min(values), max(values)
        unit = _unit(results.settings["parameters"][base])
        text += (
            f" The {parameter_words(base)} differs between lots, from <b>{number(low, 2)}</b> "
            f"{unit} ({lot_words(low_lot)}) to <b>{number(high, 2)}</b> {unit} "
            f"({lot_words(high_lot)})."
        )
    return Markup(text.strip())


def _misfit_sentence(results: Results, use: str) -> Markup:
    misfit = results.comparison["misfit"].get(use)
    if not misfit or not misfit["n"]:
        return Markup("")
    shots = sum(1 for shot in results.comparison["shots"] if shot["use"] == use)
    which = "fitted" if use == "calibrate" else "held back from the fit"
    verdict = (
        "about what the errors of measurement and network explain"
        if misfit["whitened_rms"] < 1.2
        else "more than the errors of measurement and network explain"
    )
    by_size = [
        f"{size_words(size)} by {percent(share)}"
        for size, share in misfit_by_size(results.comparison, use).items()
    ]
    return Markup(
        f"On the {counted(misfit['n'], 'datum').replace('datums', 'data')} of "
        f"{counted(shots, 'shot')} {which} the model is off by "
        f"<b>{misfit['whitened_rms']:.2f}</b> standard errors (root mean square), {verdict}: "
        f"{listed(by_size)} of the size before impact."
    )


def _failure_sentence(results: Results) -> Markup:
    found = results.comparison["findings"]
    if not found:
        return Markup("No lot, size, shape or range of velocities deviates beyond its errors.")
    return Markup(f"It fails most here: {'; '.join(map(str, map(escape, found[:3])))}.")


def _bound_sentence(results: Results) -> Markup:
    """Parameters whose interval reaches an end of the prior range."""
    open_below, open_above = [], []
    for entry in results.comparison["parameters"]:
        prior = results.settings["parameters"].get(split_name(entry["name"])[0])
        if prior and _position(entry["lower95"], prior) < NEAR_END:
            open_below.append(parameter_words(entry["name"]))
        if prior and _position(entry["upper95"], prior) > 1 - NEAR_END:
            open_above.append(parameter_words(entry["name"]))
    sides = ((open_below, "below"), (open_above, "above"))
    parts = [f"{listed(names)} from {side}" for names, side in sides if names]
    return Markup(
        f"Within the priors the data do not bound {'; nor '.join(parts)}." if parts else ""
    )


def _network_sentence(results: Results) -> Markup:
    """Sizes in which the network errs more than the measurement."""
    errors: dict[str, list[float]] = {}
    for entry in results.emulator["validation"]["by_output"]:
        errors.setdefault(entry["output"], []).append(entry["rms"])
    stated: dict[str, list[float]] = {}
    for shot in results.comparison["shots"]:
        for cell in shot["sizes"]:
            stated.setdefault(cell["size"], []).append(cell["sd"])
    worse = [size_words(size) for size, sds in stated.items() if max(errors[size]) > median(sds)]
    if not worse:
        return Markup("")
    return Markup(
        f"In {listed(worse)} the network is less accurate than the measurement: more runs, or a "
        "longer training, would sharpen the result."
    )


def odd_data(results: Results) -> list[dict]:
    """Single data far from the best model: a bad datum or a missing effect."""
    found = [
        {
            "id": shot["id"],
            "lot": lot_words(shot["lot"]),
            "use": {"calibrate": "fitted", "validate": "held back"}[shot["use"]],
            "velocity": number(shot["velocity_m_s"]),
            "size": size_words(cell["size"]),
            "measured": f"{cell['measured']:.2f}",
            "predicted": f"{cell['predicted']:.2f}",
            "whitened": cell["whitened"],
        }
        for shot in results.comparison["shots"]
        for cell in shot["sizes"]
        if abs(cell["whitened"]) > ODD_DATUM
    ]
    return sorted(found, key=lambda datum: -abs(datum["whitened"]))


def steering_shots(results: Results) -> list[dict]:
    """Shots without which a parameter would move noticeably."""
    found = [
        {
            "id": entry["id"],
            "shift": f"{entry['largest_shift_sd']:.1f}",
            "parameter": parameter_words(entry["parameter"]),
        }
        for entry in results.comparison["influence"]
        if entry["largest_shift_sd"] > STEERING
    ]
    return sorted(found, key=lambda shot: -float(shot["shift"]))


def lot_rows(results: Results) -> list[dict]:
    """The table of what was measured, a line for each lot."""
    rows = []
    for lot in results.lots:
        mine = [row for row in results.rows if row["lot"] == lot]
        uses = [row["use"] for row in mine]
        sizes = dict.fromkeys(key for row in mine for key in row if _is_size(key))
        rows.append(
            {
                "lot": lot_words(lot),
                "metal": listed(sorted({row["material"] for row in mine} - {""})),
                "shapes": listed(list(dict.fromkeys(shape_words(r["shape"]) for r in mine))),
                "fitted": uses.count("calibrate"),
                "held": uses.count("validate"),
                "ignored": uses.count("ignore"),
                "velocity": _span([row["velocity_m_s"] for row in mine]),
                "diameter": _span([row["initial_diameter_mm"] for row in mine]),
                "ratio": _span(
                    [row["initial_length_mm"] / row["initial_diameter_mm"] for row in mine]
                ),
                "sizes": ", ".join(size_words(size) for size in sizes),
            }
        )
    return rows


def _is_size(key: str) -> bool:
    return key.endswith("_mm") and not key.startswith("initial")


def _span(values: list[float]) -> str:
    low, high = f"{min(values):.3g}", f"{max(values):.3g}"
    return low if low == high else f"{low}–{high}"


def sources(results: Results) -> list[tuple[str, int]]:
    found: dict[str, int] = {}
    for row in results.rows:
        found[row["source"]] = found.get(row["source"], 0) + 1
    return list(found.items())


def maxima_rows(results: Results) -> list[tuple[str, list]]:
    """A line for each parameter, a column for each maximum."""
    posterior = results.posterior
    drops = posterior.maxima_log_density.max() - posterior.maxima_log_density
    rows = [
        ("share of the posterior", [percent(share, 0) for share in posterior.maxima_share]),
        ("ln density below the highest", [f"{drop:.1f}" for drop in drops]),
    ]
    for name, values in zip(posterior.names, posterior.maxima.T, strict=True):
        rows.append((parameter_words(name), [number(value) for value in values]))
    return rows


def network_rows(results: Results) -> list[dict]:
    return [
        {
            "size": size_words(entry["output"]),
            "shape": shape_words(entry["shape"]),
            "rms": percent(entry["rms_relative"], 2),
            "largest": percent(entry["largest_relative"], 1),
            "rms_mm": number(entry["rms"], 2),
            "n": entry["n"],
        }
        for entry in results.emulator["validation"]["by_output"]
    ]
