"""Numbers and names as a reader wants them."""

import math
import re
from collections.abc import Iterable

from markupsafe import Markup, escape

from shape_names import in_words
from size_kinds import OUTLINE_SCORES

SIZE_WORDS = {
    "final_length_mm": "final length",
    "impact_diameter_mm": "impact diameter",
    "head_length_mm": "head length",
    "rear_length_mm": "rear length",
    "transition_diameter_mm": "transition diameter",
    "undeformed_length_mm": "undeformed length",
    "diameter_at_0p2L0_mm": "diameter at 0.2 L0",
    **{name: f"outline, component {name[-1]}" for name in OUTLINE_SCORES},
}
PARAMETER_WORDS = {
    "rho_immobile_initial": "initial immobilized density",
    "hardening_coefficient": "hardening coefficient",
    "immobilization_velocity": "immobilization velocity",
    "unexplained_spread": "unexplained spread",
}
EFFECT_WORDS = {
    "anvil_friction": "friction on the anvil",
    "thermal_softening": "thermal softening",
    "hall_petch": "strengthening by grain refinement",
    "damage_softening": "softening by weakened areas",
    "phonon_drag": "phonon drag",
    "taylor_quinney_shift": "share of work turned to heat",
    "back_stress": "back stress",
    "rod_texture": "texture of the rod",
    "hard_skin": "hard machined skin",
    "forest_storage": "storage at the forest",
    "elastic_anvil": "elastic anvil",
    "oblique_impact": "oblique impact",
    "dynamic_recovery": "dynamic recovery",
    "velocity_bias": "error of the velocity meter",
}
PARAMETER_SYMBOLS = {
    "rho_immobile_initial": "ρ<sub>I</sub>(0)",
    "hardening_coefficient": "A<sub>I</sub>",
    "immobilization_velocity": "V<sub>I</sub>",
    "unexplained_spread": "τ",
}
GREEK = {
    "alpha": "α",
    "beta": "β",
    "gamma": "γ",
    "eps": "ε",
    "eta": "η",
    "theta": "θ",
    "kappa": "κ",
    "mu": "μ",
    "rho": "ρ",
    "sigma": "σ",
    "tau": "τ",
}
UNIT_WORDS = {
    "none": "",
    "1": "",
    "1/m2": "m⁻²",
    "1/m3": "m⁻³",
    "kg/m3": "kg/m³",
    "J/m2": "J/m²",
    "MPa m^0.5": "MPa √m",
    "dex": "decades",
    "deg": "°",
}
USE_WORDS = {"calibrate": "fitted", "validate": "held back", "ignore": "left out"}
THIRDS = {"low": "slow third", "middle": "middle third", "high": "fast third"}


def shape_words(shape: str) -> str:
    return "all shapes" if shape == "all" else in_words(shape)


def third_words(limits: list[float], narrow: bool = False) -> dict[str, str]:
    """Thirds of the velocities, which meet at `limits` [m/s]; "slow third, ≤ 63 m/s" or "≤ 63"."""
    low, high = (f"{limit:.0f}" for limit in limits)
    spans = dict(zip(THIRDS, (f"≤ {low}", f"{low}–{high}", f"> {high}")))
    return spans if narrow else {key: f"{THIRDS[key]}, {spans[key]} m/s" for key in THIRDS}


def relative_words(sizes: Iterable[str]) -> str:
    """What deviations in per cent of these sizes refer to; as `calibrate` has it."""
    others = []
    if "undeformed_length_mm" in sizes:
        others.append("the undeformed length's of L0")
    if set(OUTLINE_SCORES) & set(sizes):
        others.append("outlines' of the initial diameter")
    return "in per cent of the size" + (f" ({', '.join(others)})" if others else "")


def split_name(name: str) -> tuple[str, str]:
    """("rho_immobile_initial", "house") of "rho_immobile_initial[house]"."""
    base, _, lot = name.partition("[")
    return base, lot.rstrip("]")


def lot_words(lot: str) -> str:
    return lot.replace("_", " ")


def parameter_words(name: str) -> str:
    base, lot = split_name(name)
    words = PARAMETER_WORDS.get(base, effect_words(base))
    return f"{words}, {lot_words(lot)}" if lot else words


def effect_words(name: str) -> str:
    return EFFECT_WORDS.get(name, name.replace("_", " "))


def size_words(size: str) -> str:
    return SIZE_WORDS.get(size, size.replace("_", " "))


def number(value: float, digits: int = 3) -> Markup:
    """3.21, 1.2 x 10^13, with a real minus and a raised exponent."""
    if value is None or not math.isfinite(value):
        return Markup("–")
    if value == 0:
        return Markup("0")
    exponent = math.floor(math.log10(abs(value)))
    if -4 < exponent < 6:
        decimals = max(digits - 1 - exponent, 0)
        return Markup(f"{value:.{decimals}f}".replace("-", "−"))
    mantissa = f"{value / 10**exponent:.{max(digits - 2, 0)}f}".replace("-", "−")
    exponent = str(exponent).replace("-", "−")
    return Markup(f"{mantissa}\u202f×\u202f10<sup>{exponent}</sup>")


def symbol(name: str) -> Markup:
    """μ with A below of "muA", ρ with I below and (0) of "rhoI(0)"; other text as it is."""
    parts = re.fullmatch(rf"({'|'.join(GREEK)}|[A-Za-z])(\w*)(\(\w+\))?", name)
    if not parts:
        return escape(name)
    letter, below, argument = parts.groups(default="")
    sub = Markup("<sub>{}</sub>").format(below) if below else ""
    return Markup("{}{}{}").format(GREEK.get(letter, letter), sub, argument)


def sentence_case(text: str) -> str:
    return text[:1].upper() + text[1:]


def percent(share: float | None, digits: int = 1) -> str:
    if share is None:
        return "–"
    return f"{100 * share:.{digits}f}\u202f%".replace("-", "−")


def signed_percent(share: float | None, digits: int = 1) -> str:
    if share is None:
        return "–"
    return f"{signed(100 * share, digits)}\u202f%"


def signed(value: float | None, digits: int = 1) -> str:
    """+1.2 or −0.3"""
    if value is None or not math.isfinite(value):
        return "–"
    rounded = round(value, digits) + 0.0  # -0.0 becomes 0.0
    return f"{rounded:+.{digits}f}".replace("-", "−")


def probability(p: float | None) -> str:
    """0.34, 0.0021 or < 0.0001"""
    if p is None:
        return "–"
    return "< 0.0001" if p < 1e-4 else f"{p:.2g}"


def duration(seconds: float) -> str:
    if seconds < 90:
        return f"{seconds:.1f} s" if seconds < 10 else f"{seconds:.0f} s"
    if seconds < 5400:
        return f"{seconds / 60:.1f} min"
    return f"{seconds / 3600:.1f} h"


def listed(words: list[str]) -> str:
    """one, two and three"""
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} and {words[-1]}"


def counted(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
