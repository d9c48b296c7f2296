"""Which blind tables there are, drawn by seed. What a table hides is in no file of its folder.

A variant is one set of shots with something hidden, so it is computed once; tables of a variant
differ in noise. Ids are shuffled, so that they tell nothing.
"""

from dataclasses import dataclass

import numpy as np

SEED = 20261125
SETS = 6
NULLS_A_SET = 18
CORRUPTED = 12
BIASED = 6
UNDERSTATED = 12
NOISES = 3  # tables of a variant with something hidden
ALL, TWINS = "all", "twins"  # the lists of candidates; "without <effect>" are the others

# How strong: signal beyond what parameters absorb, in standard errors, or from the prior.
SIX_SIGMA, FROM_PRIOR, STRONG = "six_sigma", "from_prior", "strong"
OTHER_METALS = {
    "johnson_cook": {"strength": "johnson_cook", "jc_a": 1.6e8},
    "linear_hardening": {"strength": "j2", "j2_yield_stress": 2.2e8, "j2_hardening_modulus": 4e8},
}
PAIRS = 4


@dataclass(frozen=True)
class Variant:
    """Runs of one set of shots. `material`: another strength model, by name."""

    shot_set: int
    effects: tuple = ()
    strength: str = ""
    material: str = ""

    @property
    def name(self) -> str:
        parts = [f"set{self.shot_set:02d}", *self.effects, self.strength, self.material]
        return "-".join(part for part in parts if part)


@dataclass(frozen=True)
class Table:
    """One blind table. `kind`: null, effect, two effects, outside, twins, bad shot, bias,
    understated errors.
    """

    id: str
    kind: str
    variant: Variant
    candidates: str
    noise: int  # stream of its noise


def variants_of_effects(effects: list[str]) -> list[Variant]:
    """Each effect at about six standard errors, and at an amplitude from its prior."""
    found = []
    for index, effect in enumerate(effects):
        for offset, strength in enumerate((SIX_SIGMA, FROM_PRIOR)):
            found.append(Variant((index + 5 * offset) % SETS, (effect,), strength))
    return found


def outside_variants(effects: list[str]) -> list[Variant]:
    """Strong effects that the list of candidates lacks, and other strength models."""
    strong = [
        Variant((3 + 2 * index) % SETS, (effect,), STRONG)
        for index, effect in enumerate(effects[::3])
    ]
    metals = [Variant(index, material=name) for index, name in enumerate(OTHER_METALS)]
    return strong + metals


def pair_variants(effects: list[str]) -> list[Variant]:
    random = np.random.default_rng([SEED, 2])
    pairs = [random.choice(effects, size=2, replace=False) for _ in range(PAIRS)]
    return [
        Variant((2 * index + 1) % SETS, (str(pair[0]), str(pair[1])), SIX_SIGMA)
        for index, pair in enumerate(pairs)
    ]


def plan(effects: list[str], twins: list[str]) -> list[Table]:
    """All tables. `effects`: those that a run can hide; `twins`: those with a twin constant."""
    plain = [Variant(index) for index in range(SETS)]
    hidden = variants_of_effects(effects)
    cases = [("null", variant, ALL) for variant in plain for _ in range(NULLS_A_SET)]
    cases += [("effect", variant, ALL) for variant in hidden for _ in range(NOISES)]
    cases += [("two effects", v, ALL) for v in pair_variants(effects) for _ in range(NOISES)]
    for variant in outside_variants(effects):
        lacking = f"without {variant.effects[0]}" if variant.effects else ALL
        cases += [("outside", variant, lacking)] * NOISES
    cases += [
        ("twins", variant, TWINS)
        for variant in hidden
        if variant.effects[0] in twins and variant.strength == SIX_SIGMA
        for _ in range(NOISES)
    ]
    cases += [("bad shot", plain[index % SETS], ALL) for index in range(CORRUPTED)]
    cases += [("bias", plain[index % SETS], ALL) for index in range(BIASED)]
    order = np.random.default_rng([SEED, 3]).permutation(len(cases))
    more = [("understated errors", plain[index % SETS], ALL) for index in range(UNDERSTATED)]
    later = np.random.default_rng([SEED, 7]).permutation(len(more)) + len(cases)
    cases, order = cases + more, np.concatenate([order, later])
    tables = [
        Table(f"t{place + 1:03d}", *case, noise)
        for noise, (place, case) in enumerate(zip(order, cases, strict=True))
    ]
    return sorted(tables, key=lambda table: table.id)


def metal_name(shot_set: int) -> str:
    """Name of the folder of a set's signatures."""
    return f"metal{shot_set}"


def list_names(tables: list[Table]) -> dict[str, str]:
    """Candidate list -> the name that its file has, which says nothing."""
    known = list(dict.fromkeys(table.candidates for table in tables))
    return {name: f"list{index}" for index, name in enumerate(known)}
