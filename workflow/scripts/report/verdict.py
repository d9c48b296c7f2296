"""The diagnosis in sentences: its verdict, and the tests behind it."""

from report.candidates import unseen_rows
from report.diagnosis_results import DiagnosisResults
from report.words import effect_words, listed, parameter_words, shape_words
from report.words import probability, sentence_case, signed, size_words

DESCRIPTOR_WORDS = {
    "stop_time_us": "time until it stopped",
    "largest_temperature_K": "largest temperature",
    "peak_strain_rate_per_s": "peak strain rate",
    "plastic_work_J": "plastic work",
    "sliding_distance_mm": "sliding distance at the anvil",
    "smallest_grain_um": "smallest grain",
    "largest_weakened_fraction": "largest weakened area",
    "largest_plastic_strain": "largest plastic strain",
    "mean_von_mises_GPa": "mean equivalent stress",
    "viscous_share": "share of artificial viscosity in the energy",
    "hourglass_share": "share of hourglass control in the energy",
    "energy_error": "error of the energy balance",
}
MOST_ROWS = 8


def heading(verdict: dict) -> str:
    """The verdict as a line of its own; `effects` in words."""
    effects = [effect_words(name) for name in verdict["effects"]]
    together = f"Missing effect{'s' if effects[1:] else ''}: {listed(effects)}"
    shots = listed(verdict["shots"])
    either = " or ".join([", ".join(effects[:-1]), effects[-1]] if effects[1:] else effects)
    return {
        "no effect supported": "No effect supported",
        "effect": together,
        "one of": f"One of these is missing: {either}",
        "not distinguishable": "Something is missing, but these data cannot tell what"
        + (f": {either}" if effects else ""),
        "outside the list": "Something is missing that is not in the list of effects",
        "bad data": f"Bad data: {'shot' if len(verdict['shots']) == 1 else 'shots'} {shots}",
    }.get(verdict["kind"], sentence_case(verdict["kind"]))


def seen_and_hidden(results: DiagnosisResults) -> tuple[list[dict], str]:
    """With a negative verdict: the amplitudes that would have been found, smallest share of
    their physical range first, and in words the effects that could not have been.
    """
    rows = unseen_rows(results)
    seen = [row for row in rows if not row["abstain"] and row["share"] and row["share"] <= 1]
    hidden = [row["name"][:1].lower() + row["name"][1:] for row in rows if row not in seen]
    return sorted(seen, key=lambda row: row["share"]), listed(hidden)


def test_rows(adequacy: dict, scores: list[float]) -> list[dict]:
    """The four tests: what each asks, its statistic, and whether it raises the flag."""
    threshold = adequacy["level_of_test"]
    battery = adequacy["battery"]
    worst = _contrast(battery[0]) if battery else ""
    degrees = adequacy["n"] - adequacy["p_parameters"]
    largest = max((abs(score) for score in scores), default=0.0)
    tests = [
        (
            "Size of all deviations",
            "Are the deviations together larger than their errors?",
            f"χ² {adequacy['chi2']:.0f}, {degrees:.0f} expected",
            adequacy["p_chi2"],
        ),
        (
            "Pattern",
            "Does a size of a shape lean to one side, or change with velocity?",
            f"worst: {worst}" if worst else "",
            adequacy["p_battery"],
        ),
        (
            "Likeness to an effect",
            "Do the deviations look like what one of the listed effects would do?",
            f"largest score {largest:.1f}",
            adequacy["p_score"],
        ),
        (
            "A single shot",
            "Is one measurement far from all that the others say?",
            "its errors counted, and how many were looked at",
            adequacy["p_bad_data"],
        ),
    ]
    return [
        {
            "name": name,
            "asks": asks,
            "found": found,
            "p": probability(p),
            "fails": p is not None and p < threshold,
        }
        for name, asks, found, p in tests
    ]


def _contrast(entry: dict) -> str:
    return f"{shape_words(entry['shape'])}, {size_words(entry['size'])}"


def battery_rows(adequacy: dict) -> list[dict]:
    """The worst contrasts, in words."""
    says = {
        ("mean", True): "measured larger at all velocities",
        ("mean", False): "measured smaller at all velocities",
        ("slope", True): "grows with velocity faster than the model",
        ("slope", False): "grows with velocity more slowly than the model",
    }
    return [
        {
            "where": sentence_case(_contrast(entry)),
            "words": says.get((entry["contrast"], entry["z"] > 0), entry["contrast"]),
            "z": signed(entry["z"]),
            "p": probability(entry["p"]),
        }
        for entry in adequacy["battery"][:MOST_ROWS]
    ]


def drift_rows(adequacy: dict) -> list[dict]:
    """Parameters that a shape, fitted alone, would have otherwise; the largest shifts first."""
    drift = sorted(adequacy["drift"], key=lambda entry: -abs(entry["shift_sd"]))
    return [
        {
            "parameter": sentence_case(parameter_words(entry["parameter"])),
            "shape": shape_words(entry["shape"]),
            "shift": signed(entry["shift_sd"]),
        }
        for entry in drift[:MOST_ROWS]
    ]


def correlation_rows(results: DiagnosisResults) -> list[dict]:
    found = results.diagnosis["unexplained"]["correlations"]
    return [
        {
            "descriptor": sentence_case(
                DESCRIPTOR_WORDS.get(entry["descriptor"], entry["descriptor"].replace("_", " "))
            ),
            "size": size_words(entry["size"]) if entry.get("size") else "all sizes",
            "rank": signed(entry["rank_correlation"], 2),
            "p": probability(entry["p"]),
        }
        for entry in sorted(found, key=lambda entry: -abs(entry["rank_correlation"]))[:MOST_ROWS]
    ]


def bad_data_rows(results: DiagnosisResults) -> list[dict]:
    return [
        {
            "id": entry["id"],
            "size": size_words(entry["size"]) if entry.get("size") else "all sizes together",
            "z": signed(entry["z"]),
            "p": probability(entry["p"]),
        }
        for entry in results.diagnosis["bad_data"]
    ]
