"""The revisions of a study in words: what each added effect did to the error."""

from markupsafe import Markup

from report.candidates import unit_words, with_unit
from report.diagnosis_charts import CLEAR_GAIN
from report.diagnosis_results import DiagnosisResults
from report.words import UNIT_WORDS, effect_words, listed, number, parameter_words
from report.words import sentence_case, signed, split_name

HARDLY = 0.02  # change of a misfit, in standard errors, that is called none


def revision_words(revision: dict) -> str:
    """ "Model without effects", then "+ friction on the anvil" for the effect added last."""
    if not revision["effects"]:
        return "Model without effects"
    return "+ " + effect_words(revision["effects"][-1])


def ladder_rows(results: DiagnosisResults) -> list[dict]:
    """A row for each revision; gains against the one before."""
    rows, before = [], None
    for revision in results.ladder:
        fitted, held_back = (_misfit(revision, use) for use in ("calibrate", "validate"))
        shifts = revision.get("shift_sd") or {}
        moved = max(shifts, key=lambda name: abs(shifts[name]), default=None)
        rows.append(
            {
                "words": revision_words(revision),
                "fitted": _two_digits(fitted),
                "held_back": _two_digits(held_back),
                "solver": [
                    _two_digits(_confirmed(results, revision["id"], use))
                    for use in ("calibrate", "validate")
                ],
                "log_evidence": _evidence(revision),
                "gain": signed(_gain(before, revision)) if before else "",
                "amplitude": _amplitude(results, revision),
                "shift": Markup("{}<br>{}").format(parameter_words(moved), signed(shifts[moved]))
                if moved
                else "",
                "new_runs": revision["new_runs"],
            }
        )
        before = revision
    return rows


def _misfit(revision: dict, use: str) -> float | None:
    misfit = revision["misfit"].get(use)
    return misfit["whitened_rms"] if misfit and misfit["n"] else None


def _confirmed(results: DiagnosisResults, revision: str, use: str) -> float | None:
    return _misfit(results.confirmations.get(revision, {"misfit": {}}), use)


def _two_digits(value: float | None) -> str:
    return "–" if value is None else f"{value:.2f}"


def _evidence(revision: dict) -> str:
    if revision.get("log_evidence") is None:
        return "–"
    text = signed(revision["log_evidence"]).lstrip("+")
    sd = revision.get("log_evidence_sd")
    return text if sd is None else f"{text} ± {sd:.1f}"


def _gain(before: dict, revision: dict) -> float | None:
    if before.get("log_evidence") is None or revision.get("log_evidence") is None:
        return None
    return revision["log_evidence"] - before["log_evidence"]


def _amplitude(results: DiagnosisResults, revision: dict) -> Markup | str:
    """Median and 95 % interval of the effect that was added last."""
    if not revision["effects"]:
        return ""
    name = revision["effects"][-1]
    entry = next((p for p in revision["parameters"] if p["name"] == name), None)
    if entry is None:
        return "–"
    candidate = results.candidates.get(name, {})
    interval = Markup("{} to {}").format(number(entry["lower95"]), number(entry["upper95"]))
    return Markup("{}<br>({})").format(with_unit(entry["median"], candidate), interval)


def sentences(results: DiagnosisResults) -> list[str]:
    """What each step brought, also when it brought nothing."""
    found = []
    for before, after in zip(results.ladder, results.ladder[1:]):
        name = effect_words(after["effects"][-1])
        parts = [
            _change(before, after, use, words)
            for use, words in (("calibrate", "fitted"), ("validate", "held-back"))
        ]
        text = f"Adding {name}: {'; '.join(part for part in parts if part)}."
        found.append(f"{text} {_judgement(before, after)}".strip())
    return found


def _change(before: dict, after: dict, use: str, words: str) -> str:
    old, new = _misfit(before, use), _misfit(after, use)
    if old is None or new is None:
        return ""
    if abs(new - old) < HARDLY:
        return f"the misfit of the {words} shots stays at {new:.2f} standard errors"
    verb = "falls" if new < old else "rises"
    return f"the misfit of the {words} shots {verb} from {old:.2f} to {new:.2f} standard errors"


def _judgement(before: dict, after: dict) -> str:
    gain = _gain(before, after)
    old, new = _misfit(before, "validate"), _misfit(after, "validate")
    if gain is not None and gain < CLEAR_GAIN:
        return f"ln Z changes by {signed(gain)} only: the data do not ask for this effect."
    if old is not None and new is not None and new > old - HARDLY:
        return "The held-back shots gain nothing by it, so that the effect remains doubtful."
    if gain is None:
        return ""
    return f"ln Z rises by {gain:.1f}: the data ask for this effect."


def parameter_table(results: DiagnosisResults) -> list[tuple[str, list]]:
    """A row for each parameter, a column for each revision: median and 95 % interval."""
    names = dict.fromkeys(p["name"] for revision in results.ladder for p in revision["parameters"])
    return [
        (_parameter(results, name), [_cell(revision, name) for revision in results.ladder])
        for name in names
    ]


def _parameter(results: DiagnosisResults, name: str) -> str:
    base, _ = split_name(name)
    if base in results.candidates:
        words, unit = effect_words(base), unit_words(results.candidates[base])
    else:
        words = parameter_words(name)
        unit = results.settings["parameters"].get(base, {}).get("unit", "none")
        unit = UNIT_WORDS.get(unit, unit)
    return sentence_case(f"{words}, {unit}" if unit else words)


def _cell(revision: dict, name: str) -> Markup | str:
    entry = next((p for p in revision["parameters"] if p["name"] == name), None)
    if entry is None:
        return ""
    ends = number(entry["lower95"]), number(entry["upper95"])
    return Markup("{} ({} to {})").format(number(entry["median"]), *ends)


def confirmation_sentences(results: DiagnosisResults) -> list[str]:
    """Whether the solver itself finds what the network promised."""
    found = []
    for revision in results.ladder:
        confirmation = results.confirmations.get(revision["id"])
        if not confirmation:
            continue
        uses = (("calibrate", "fitted"), ("validate", "held-back"))
        parts = []
        for use, words in uses:
            solver, network = _misfit(confirmation, use), _misfit(revision, use)
            if solver is not None:
                by_network = "" if network is None else f" (network {network:.2f})"
                parts.append(f"{solver:.2f}{by_network} on the {words} shots")
        name = revision_words(revision)
        lost = [i for use, _ in uses for i in confirmation["misfit"][use].get("not_stopped", [])]
        without = f", without {listed(lost)}, whose runs did not stop" if lost else ""
        found.append(f"{name}: the solver's own misfit is {' and '.join(parts)}{without}.")
    return found
