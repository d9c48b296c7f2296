"""Holds each diagnosis against the truth of its table, and counts.

Each question has the tables that it is asked of, what counts as success, and the share that the
acceptance wants: at least, at most, or between.
"""

import json
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from intervals import clopper_pearson

VISIBLE = 6.0  # standard errors of a hidden effect's signal
HIDDEN_BY_PARAMETERS = 0.1  # identifiability below which an effect is confounded
GRAINS_OF_FINER_RUNS = 16  # a cell: fewer scatter more than the diagnosis counts
TWIN = 0.9  # likeness from which two candidates cannot be told apart
ABSTAINING = {"no effect supported", "one of", "not distinguishable"}


@dataclass(frozen=True)
class Case:
    """One table: its sealed truth, its diagnosis, and the refit where an effect was named."""

    id: str
    truth: dict
    diagnosis: dict
    refit: dict | None = None
    left_sd: float = 0.0  # of `left_over`
    distances: dict | None = None  # of the refit's parameters, by `distances_to_truth`

    @property
    def verdict(self) -> dict:
        return self.diagnosis["verdict"]

    @property
    def kind(self) -> str:
        return self.truth["kind"]

    @property
    def hidden(self) -> list[str]:
        """Names of what is hidden; a bias of the velocities counts as the effect of that name."""
        return ["velocity_bias"] if self.kind == "bias" else list(self.truth["effects"])

    @property
    def named(self) -> set[str]:
        """The verdict's effects and every candidate said to be in the set."""
        members = {item["name"] for item in self.diagnosis["candidates"] if item["in_set"]}
        return members | set(self.verdict["effects"])

    @property
    def is_visible(self) -> bool:
        return self.signal_sd >= VISIBLE

    @property
    def signal_sd(self) -> float:
        """Signal of the hidden effect with all errors that the diagnosis counts, the solver's
        own too; of the measurements' alone where several or none of the list are hidden.
        """
        if self.kind not in ("effect", "twins"):
            return self.truth["signal_sd"]
        ((name, amplitude),) = self.truth["effects"].items()
        unit = self.candidate(name)["signal_per_unit"]
        return abs(amplitude) * unit if unit > 0 else self.truth["signal_sd"]

    @property
    def has_double(self) -> bool:
        """Whether what is hidden resembles a candidate of the list."""
        return any(cosine > TWIN for _, cosine in self.truth["most_alike"].values())

    @property
    def is_confounded(self) -> bool:
        weak = [eta < HIDDEN_BY_PARAMETERS for eta in self.truth["identifiability"].values()]
        return any(weak) or self.has_double

    @property
    def names_one_wrongly(self) -> bool:
        wrong = not set(self.verdict["effects"]) & set(self.hidden)
        return self.verdict["kind"] == "effect" and wrong

    def candidate(self, name: str) -> dict | None:
        found = [item for item in self.diagnosis["candidates"] if item["name"] == name]
        return found[0] if found else None


def left_over(cases: list[Case]) -> list[Case]:
    """The cases with what their hidden effect leaves after the parameters are fitted anew.

    In standard errors: the root of how much chi^2 of the tables with the same effect and metal
    exceeds that of the metal's tables with nothing hidden, both averaged over their noises.
    """

    def metal(case: Case) -> tuple:
        return tuple(case.truth["parameters"].values())

    def mean_chi2(chosen: list[Case]) -> float:
        return float(np.mean([case.diagnosis["adequacy"]["chi2"] for case in chosen]))

    nulls, alike = defaultdict(list), defaultdict(list)
    for case in cases:
        if case.kind == "null":
            nulls[metal(case)].append(case)
        elif case.kind == "effect":
            alike[metal(case), json.dumps(case.truth["effects"])].append(case)
    left = {}
    for (of_metal, _), chosen in alike.items():
        if nulls[of_metal]:
            excess = mean_chi2(chosen) - mean_chi2(nulls[of_metal])
            left |= {case.id: max(excess, 0.0) ** 0.5 for case in chosen}
    return [replace(case, left_sd=left.get(case.id, 0.0)) for case in cases]


@dataclass(frozen=True)
class Question:
    """`asked` chooses the tables, `met` counts them; `at_least` and `at_most` are acceptance."""

    name: str
    asked: Callable[[Case], bool]
    met: Callable[[Case], bool]
    at_least: float | None = None
    at_most: float | None = None


@dataclass(frozen=True)
class Answer:
    """Counted: `hits` of `trials`, with the exact 95 % interval of the share."""

    question: Question
    hits: int
    trials: int
    misses: list = field(default_factory=list)

    @property
    def share(self) -> float:
        return self.hits / self.trials if self.trials else float("nan")

    @property
    def interval(self) -> tuple[float, float]:
        return clopper_pearson(self.hits, self.trials)

    @property
    def wanted(self) -> str:
        low, high = self.question.at_least, self.question.at_most
        if low is not None and high is not None:
            return f"{100 * low:.0f} to {100 * high:.0f} %"
        if low is not None:
            return f">= {100 * low:.0f} %"
        return "" if high is None else f"<= {100 * high:.0f} %"

    @property
    def verdict(self) -> str:
        """met or missed by the share itself; the interval tells how sure that is."""
        if not self.trials or not self.wanted:
            return "not asked" if not self.trials else ""
        low, high = self.question.at_least, self.question.at_most
        above = low is None or self.share >= low
        below = high is None or self.share <= high
        return "met" if above and below else "missed"


def left_out_falls(case: Case) -> bool:
    return case.refit["with"]["left_out_chi2"] < case.refit["without"]["left_out_chi2"]


def left_out_in_turn_falls(case: Case) -> bool:
    key = "left_out_in_turn_chi2"
    return case.refit["with"][key] < case.refit["without"][key]


def moves_toward_truth(case: Case) -> bool:
    """Distance to the true parameters, in the metric of the fit's information, linear."""
    information = np.array(case.refit["information"])

    def distance(which: str) -> float:
        found, true = case.refit[which]["parameters"], case.truth["parameters"]
        ranges = case.refit["ranges"]
        away = [(found[n] - true[n]) / (ranges[n][1] - ranges[n][0]) for n in true]
        return float(np.array(away) @ information @ np.array(away))

    return distance("with") < distance("without")


def predicts_like_truth(case: Case) -> bool:
    """Distance to the true parameters by what they predict, along curved ridges, too."""
    return case.distances["with"] < case.distances["without"]


def amplitude_covered(case: Case) -> bool:
    name = case.hidden[0]
    found = case.candidate(name)
    return found["lower95"] <= case.truth["effects"][name] <= found["upper95"]


def _has_interval(case: Case) -> bool:
    found = case.candidate(case.hidden[0]) if case.kind == "effect" else None
    return found is not None and found["lower95"] is not None


def _is(kind: str) -> Callable[[Case], bool]:
    return lambda case: case.kind == kind


def _visible_effect(case: Case) -> bool:
    return case.kind == "effect" and case.is_visible


def _leaves_misfit(case: Case) -> bool:
    return case.kind == "effect" and case.left_sd >= VISIBLE


def _named_rightly(case: Case) -> bool:
    """An effect was added, and it is the hidden one."""
    return case.kind == "effect" and case.refit is not None and case.refit["effect"] in case.hidden


def _flagged(case: Case) -> bool:
    return case.verdict["flagged"]


def _abstains(case: Case) -> bool:
    return case.verdict["kind"] in ABSTAINING


def _outside(case: Case) -> bool:
    return case.verdict["kind"] == "outside the list"


def _lacks_effect(case: Case) -> bool:
    return case.kind == "outside" and not case.truth["material"]


def _found_bad_shot(case: Case) -> bool:
    return case.truth["corrupted"]["id"] in case.verdict["shots"]


def _hits_set(case: Case) -> bool:
    return bool(set(case.hidden) & case.named)


def _grains(case: Case) -> int:
    return case.truth["numerics"]["grains_per_point"]


QUESTIONS = [
    Question("false flags on tables with nothing hidden", _is("null"), _flagged, at_most=0.05),
    Question(
        "false flags, tables of cells with sixteen grains",
        lambda case: case.kind == "null" and _grains(case) >= GRAINS_OF_FINER_RUNS,
        _flagged,
        at_most=0.05,
    ),
    Question("an effect of 6 standard errors or more is flagged", _visible_effect, _flagged, 0.85),
    Question(
        "flagged: the hidden effect is in the set",
        lambda case: _visible_effect(case) and _flagged(case),
        _hits_set,
        0.95,
    ),
    Question(
        "an effect that leaves 6 standard errors after a refit is flagged",
        _leaves_misfit,
        _flagged,
        0.85,
    ),
    Question(
        "one that leaves 6 standard errors, flagged: it is in the set",
        lambda case: _leaves_misfit(case) and _flagged(case),
        _hits_set,
        0.95,
    ),
    Question(
        "a wrong effect is named alone",
        _visible_effect,
        lambda case: case.names_one_wrongly,
        at_most=0.05,
    ),
    Question(
        "a confounded effect is not named alone",
        lambda case: case.kind in ("effect", "twins") and case.is_visible and case.is_confounded,
        _abstains,
        0.95,
    ),
    Question("two effects: at least one is in the set", _is("two effects"), _hits_set),
    Question("two effects: flagged", _is("two effects"), _flagged),
    Question(
        "outside the list: says so (an effect unlike all in the list)",
        lambda case: _lacks_effect(case) and not case.has_double,
        _outside,
        0.80,
    ),
    Question(
        "outside the list: says so (an effect that a listed one resembles)",
        lambda case: _lacks_effect(case) and case.has_double,
        _outside,
    ),
    Question(
        "outside the list: says so (another strength model)",
        lambda case: case.kind == "outside" and bool(case.truth["material"]),
        _outside,
        0.80,
    ),
    Question(
        "the hidden effect added: error of every shot, left out in turn, falls",
        _named_rightly,
        left_out_in_turn_falls,
        0.90,
    ),
    Question(
        "the hidden effect added: error of the fifth held back falls",
        _named_rightly,
        left_out_falls,
        0.90,
    ),
    Question(
        "the hidden effect added: parameters move toward the truth",
        _named_rightly,
        moves_toward_truth,
        0.90,
    ),
    Question(
        "the hidden effect added: parameters predict more nearly what the true ones do",
        lambda case: _named_rightly(case) and case.distances is not None,
        predicts_like_truth,
        0.90,
    ),
    Question(
        "the amplitude's 95 % interval covers",
        _has_interval,
        amplitude_covered,
        0.90,
        0.99,
    ),
    Question("one wrong number: the shot is found", _is("bad shot"), _found_bad_shot, 0.90),
    Question(
        "a bias of the velocities is not taken for an effect",
        _is("bias"),
        lambda case: not case.names_one_wrongly,
        0.95,
    ),
    Question(
        "errors twice as large as stated are not taken for an effect",
        _is("understated errors"),
        lambda case: case.verdict["kind"] not in ("effect", "one of"),
        0.95,
    ),
    Question(
        "errors twice as large as stated: nothing is flagged, and the scatter is told",
        _is("understated errors"),
        lambda case: not _flagged(case) and bool(case.diagnosis["errors"]["unstated_scatter"]),
        0.80,
    ),
]


def answers(cases: list[Case]) -> list[Answer]:
    """Every question asked of all cases; `misses` are the ids that a reader would look at."""
    found = []
    for question in QUESTIONS:
        asked = [case for case in cases if question.asked(case)]
        hits = [case for case in asked if question.met(case)]
        wanted_high = question.at_most is None or question.at_least is not None
        hit_ids = {case.id for case in hits}
        misses = [case.id for case in asked if (case.id in hit_ids) != wanted_high]
        found.append(Answer(question, len(hits), len(asked), misses))
    return found
