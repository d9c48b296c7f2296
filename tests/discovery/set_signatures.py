"""Writes the designs of the signatures that tables of one set of shots are diagnosed with.

/usr/bin/python3 tests/discovery/set_signatures.py --study tests/discovery/study \\
    --measurements t001/measurements.csv --posterior t001/posterior.h5 \\
    --design design.h5 --finer finer.h5

As the product does for a study of its own: velocities over the range of the table, parameters
drawn from its posterior. Nothing here knows the truth. One table stands for all of its set,
since 400 runs for each table would take days.
"""

import argparse
from pathlib import Path

import numpy as np
from hidden_signal import SignalTable, visible_amplitude
from hide import WITHIN, read_candidates, read_signatures
from make_design import write_design
from make_signature_design import base_rows, points, read_draws
from measurements import read_measurements
from network import Network
from refit import read_table
from shot_inputs import SHOT_INPUTS
from specimens import TRUTHS

POINTS_A_SHAPE = 18
SEED = 77
# Amplitudes of the pairs: this many standard errors of measurements and network, as far as
# the range allows. What is hidden lies below; far beyond it sizes bend.
SIGMAS = 14
SHARES = (0.5, 1.0)  # in turn, so that a curvature shows


def pair_amplitudes(candidates, table: SignalTable, signatures) -> list[float]:
    """One a candidate, with the sign of its usual one."""
    found = []
    for candidate in candidates:
        sign = np.sign(candidate["typical"])
        visible = visible_amplitude(table, signatures, candidate, SIGMAS)
        end = candidate["highest"] if sign > 0 else candidate["lowest"]
        found.append(float(sign * min(visible, WITHIN * abs(end - candidate["base"]))))
    return found


def pair_design(rows: list[dict], draws: dict, candidates, amplitudes: list[float]) -> dict:
    """For each point a plain run and one run a candidate, of the same seed."""
    places = points(rows, POINTS_A_SHAPE)
    random = np.random.default_rng(SEED)
    seeds = random.integers(1, 2**31, size=len(places))
    chosen = random.choice(len(draws[next(iter(TRUTHS))]), size=len(places), replace=False)
    base = np.array([candidate["base"] for candidate in candidates])
    changes = np.vstack([np.zeros_like(base), np.diag(amplitudes)])
    inputs = []
    for index, place in enumerate(places):
        shot = [place[name] for name in SHOT_INPUTS]
        shot += [float(draws[name][chosen[index]]) for name in TRUTHS]
        share = SHARES[index % len(SHARES)]
        inputs += [[*shot, *(base + share * change)] for change in changes]
    repeats = len(changes)
    return {
        "run_id": np.arange(len(inputs), dtype=np.int64),
        "seed": np.repeat(seeds, repeats).astype(np.int64),
        "shape": [place["shape"] for place in places for _ in range(repeats)],
        "inputs": np.array(inputs),
        "names": [*SHOT_INPUTS, *TRUTHS, *(candidate["name"] for candidate in candidates)],
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("study", "measurements", "posterior", "design", "finer"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    options = parser.parse_args()
    network = Network.from_file(options.study / "emulator.json")
    candidates = read_candidates(options.study)
    draws = read_draws(options.posterior)
    middle = {name: float(np.median(draws[name])) for name in TRUTHS}
    table = SignalTable(network, read_table(options.measurements)[0], middle)
    signatures = read_signatures(options.study / "signatures.h5", candidates, network)
    amplitudes = pair_amplitudes(candidates, table, signatures)
    rows = read_measurements(options.measurements)
    pairs = pair_design(rows, draws, candidates, amplitudes)
    write_design(options.design, pairs)
    write_design(options.finer, base_rows(pairs, len(candidates)))


if __name__ == "__main__":
    main()
