"""Writes design.h5 and solver.json of a variant: its shots, with something hidden.

/usr/bin/python3 tests/discovery/hide.py --study tests/discovery/study --set 3 \\
    --signatures signatures.h5 --effects anvil_friction --strength six_sigma \\
    --design design.h5 --settings solver.json
"""

import argparse
import json
from pathlib import Path

import h5py
import numpy as np
from hidden_signal import SignalTable, drawn_amplitude, visible_amplitude
from make_design import write_design
from network import Network
from plan import FROM_PRIOR, OTHER_METALS, SEED, SIX_SIGMA, STRONG, Variant
from signature_model import SignatureModel, read_pairs
from specimens import TRUTHS, design_of, shot_set

# Standard errors of the measurements and of the network. The diagnosis counts more, above all
# what is alike for all shots of a shape: it mostly leaves a third to two thirds of a signal.
SIGMAS = {SIX_SIGMA: 12.0, STRONG: 24.0, FROM_PRIOR: 14.0}
# What is listed stays below the amplitudes of its pairs: a fit that ends beyond them asks for
# others, which a user would compute and these tables cannot.
BELOW_PAIRS = 0.9
WITHIN = 0.95  # share of an effect's range that is used


def read_candidates(study: Path) -> list[dict]:
    return json.loads((study / "candidates.json").read_text())["candidates"]


def read_signatures(path: Path, candidates: list[dict], network: Network) -> SignatureModel:
    """Signatures of all candidates from the paired runs in `path`."""
    pairs = read_pairs(path, candidates, list(TRUTHS), network.outputs)
    return SignatureModel(pairs, list(TRUTHS))


def largest_amplitude(pairs: Path, candidate: dict) -> float:
    """Of a candidate among its pairs of runs."""
    with h5py.File(pairs) as file:
        names = [str(name) for name in file["inputs"].attrs["names"]]
        values = file["inputs"][:, names.index(candidate["name"])]
    return float(np.abs(values - candidate["base"]).max())


def amplitudes(variant: Variant, study: Path, pairs: Path) -> dict[str, float]:
    """Amplitude of each hidden effect; the same for the same seed. `pairs`: the set's."""
    network, candidates = Network.from_file(study / "emulator.json"), read_candidates(study)
    table = SignalTable.of_set(network, shot_set(variant.shot_set, SEED))
    signatures = read_signatures(pairs, candidates, network)
    by_name = {item["name"]: item for item in candidates}
    random = np.random.default_rng([SEED, 4, *variant.name.encode()])
    found = {}
    for name in variant.effects:
        candidate = by_name[name]
        sign = random.choice([-1, 1]) if candidate["signed"] else 1
        size = visible_amplitude(table, signatures, candidate, SIGMAS[variant.strength])
        if variant.strength == FROM_PRIOR:
            size = min(size, drawn_amplitude(candidate, random))
        if variant.strength != STRONG:
            size = min(size, BELOW_PAIRS * largest_amplitude(pairs, candidate))
        limits = WITHIN * candidate["lowest"], WITHIN * candidate["highest"]
        found[name] = float(np.clip(sign * size, *limits))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--study", type=Path, required=True)
    parser.add_argument("--signatures", type=Path, help="paired runs of the set")
    parser.add_argument("--set", type=int, required=True)
    parser.add_argument("--effects", nargs="*", default=[])
    parser.add_argument("--strength", choices=[*SIGMAS, ""], default="")
    parser.add_argument("--material", choices=[*OTHER_METALS, ""], default="")
    parser.add_argument("--design", type=Path, required=True)
    parser.add_argument("--settings", type=Path, required=True)
    options = parser.parse_args()
    variant = Variant(options.set, tuple(options.effects), options.strength, options.material)
    shots = shot_set(variant.shot_set, SEED)
    hidden = amplitudes(variant, options.study, options.signatures) if variant.effects else {}
    write_design(options.design, design_of(shots, hidden))
    settings = {
        "geometry": "axisymmetric",
        "fidelity": "standard",  # its bound on work; the resolution is the set's own
        "numerics": shots.numerics,
        "material": OTHER_METALS.get(variant.material, {}),
    }
    options.settings.write_text(json.dumps(settings, indent=1) + "\n")


if __name__ == "__main__":
    main()
