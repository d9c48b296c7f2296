"""Candidate effects in words and as rows of tables."""

from markupsafe import Markup

from report.diagnosis_results import DiagnosisResults
from report.words import UNIT_WORDS, effect_words, listed, number, sentence_case, signed, symbol


def unit_words(candidate: dict) -> str:
    unit = candidate.get("unit", "none")
    return UNIT_WORDS.get(unit, unit)


def with_unit(value: float | None, candidate: dict, digits: int = 3) -> Markup:
    return Markup("{} {}").format(number(value, digits), unit_words(candidate)).strip()


def largest_physical(candidate: dict) -> float | None:
    """The amplitude farthest from absence that its physical range allows, or None."""
    if "lowest" not in candidate or "highest" not in candidate:
        return None
    base = candidate.get("base", 0)
    return max(abs(candidate["highest"] - base), abs(candidate["lowest"] - base)) or None


def ranking_rows(results: DiagnosisResults) -> list[dict]:
    """The table of candidates, best first; every number with its unit or as a plain ratio."""
    return [
        {
            "name": sentence_case(effect_words(entry["name"])),
            "symbol": symbol(entry.get("symbol", "")),
            "about": entry.get("description", ""),
            "constant": entry["kind"] == "constant",
            "amplitude": with_unit(entry["amplitude"], entry),
            "interval": Markup(f"{number(entry['lower95'])} to {number(entry['upper95'])}"),
            "score": signed(entry["score"]),
            **_gains(entry),
            "identifiability": f"{entry['identifiability']:.2f}",
            "in_set": entry["in_set"],
            "abstain": entry["abstain"],
            "remark": _remark(entry),
        }
        for entry in results.ranked
    ]


def _gains(entry: dict) -> dict:
    keys = {
        "gain": "log_evidence_gain",
        "gain_half": "log_evidence_gain_half_width",
        "gain_double": "log_evidence_gain_double_width",
        "left_out": "leave_shape_out_gain",
    }
    return {name: signed(None if entry["abstain"] else entry[key]) for name, key in keys.items()}


def _remark(entry: dict) -> str:
    if entry["in_set"]:
        return "in the set"
    if entry["abstain"]:
        return "parameters imitate it"
    if not entry["physical_sign"]:
        return "wrong sign"
    return ""


def remarks(results: DiagnosisResults) -> list[tuple[str, str]]:
    """What the diagnosis says of those that matter: the set, and the five best."""
    return [
        (sentence_case(effect_words(entry["name"])), entry["words"])
        for place, entry in enumerate(results.ranked)
        if entry["words"] and (entry["in_set"] or place < 5)
    ]


def pair_rows(results: DiagnosisResults) -> list[tuple[str, str]]:
    """Two effects together, the best gains first."""
    pairs = sorted(results.diagnosis["pairs"], key=lambda pair: -pair["log_evidence_gain"])
    return [
        (
            listed([effect_words(name) for name in pair["effects"]]),
            signed(pair["log_evidence_gain"]),
        )
        for pair in pairs[:5]
    ]


def unseen_rows(results: DiagnosisResults) -> list[dict]:
    """The smallest amplitude that would have been seen, and its share of the physical range."""
    rows = []
    for entry in results.ranked:
        largest, smallest = largest_physical(entry), entry["smallest_detectable"]
        share = None
        if largest and smallest is not None:
            share = smallest / largest
        rows.append(
            {
                "name": sentence_case(effect_words(entry["name"])),
                "smallest": "–" if entry["abstain"] else with_unit(smallest, entry),
                "largest": with_unit(largest, entry),
                "share": share,
                "abstain": entry["abstain"],
                "words": _seen_words(entry, share),
            }
        )
    return rows


def _seen_words(entry: dict, share: float | None) -> str:
    if entry["abstain"]:
        return "never: a change of the parameters looks the same"
    if share is None:
        return "no physical range is stated"
    if share > 1:
        return "not even at the largest physical amplitude"
    return f"from {100 * share:.2g} % of its largest physical amplitude"
