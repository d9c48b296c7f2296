"""Time of `calibrate sample`, emcee and nested sampling for the same likelihood and as many
effective draws. Usage: bench_samplers.py
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, "tests/verification")
from nested_sampling import NestedSampling  # noqa: E402
from sampler_study import emcee_chain, likelihood_of, sample, unit, write_table  # noqa: E402


def timed(work):
    start = time.perf_counter()
    result = work()
    return result, time.perf_counter() - start


def main():
    print("samplers, one likelihood of 9 rows x 3 sizes, 3 parameters; effective draws a second")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_table(folder)
        found, seconds = timed(lambda: sample(folder, "bench"))
        ours = found.attrs["effective_sample_size"] / seconds
        print(f"  calibrate sample: {ours:.0f} (ln Z to {found.attrs['ln_evidence_sd']:.3f})")
        likelihood = likelihood_of(folder, found)
        start = unit(found["draws"][:40, :3])
        try:
            (chain, length), seconds = timed(lambda: emcee_chain(likelihood, start, 500))
            rate = len(chain) / length / seconds
            print(f"  emcee, with the network in numpy: {rate:.0f}, {ours / rate:.0f} times slower")
        except ImportError:
            print("  emcee is not here to compare with: apt-get install python3-emcee")
        (_, error, _, weights), seconds = timed(lambda: NestedSampling(likelihood, 3).run())
        rate = 1 / np.square(weights).sum() / seconds
        print(
            f"  nested sampling, in numpy: {rate:.0f} (ln Z to {error:.3f}), "
            f"{ours / rate:.0f} times slower"
        )


if __name__ == "__main__":
    main()
