"""Numbers and names as a reader wants them."""

import math

from markupsafe import Markup, escape

from study import OUTLINE_SCORES

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
SHAPE_WORDS = {
    "all": "all shapes",
    "uniform_cylinder": "uniform cylinder",
    "reduced_head_4mm": "4-mm head",
    "reduced_head_3mm": "3-mm head",
    "truncated_cone": "truncated cone",
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
    "delta": "δ",
    "eta": "η",
    "kappa": "κ",
    "lambda": "λ",
    "mu": "μ",
    "rho": "ρ",
    "sigma": "σ",
    "tau": "τ",
    "theta": "θ",
    "chi": "χ",
}
UNIT_WORDS = {"none": "", "1/m2": "m⁻²"}
USE_WORDS = {"calibrate": "fitted", "validate": "held back", "ignore": "left out"}
THIRD_WORDS = {"low": "slow third", "middle": "middle third", "high": "fast third"}


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
    """μ of "mu", k with HP below of "k_HP"; other text as it is."""
    parts = [" ".join(GREEK.get(w, w) for w in part.split(" ")) for part in name.split("_")]
    letters = [escape(part) for part in parts]
    return letters[0] + Markup("").join(Markup("<sub>{}</sub>").format(b) for b in letters[1:])


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
    if value is None:
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
