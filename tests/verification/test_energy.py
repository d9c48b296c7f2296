"""Every joule of a fast axisymmetric impact is accounted for, in every shape.

Particles: tests/unit/sph/test_body.cpp; whole impacts of both: figures/energy.png.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent / "studies"))

from impact_runs import SHAPES  # noqa: E402


@pytest.mark.parametrize("shape", SHAPES)
def test_energy_is_balanced_with_viscosity_and_hourglass_work(solver, shape):
    command = [solver, "run", "--json", "--shape", shape, "--velocity", "120"]
    command += ["--geometry", "axisymmetric", "--fidelity", "coarse"]
    finished = subprocess.run(command, capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    found = json.loads(finished.stdout)["descriptors"]
    assert found["energy_error"] < 0.005
    # Without them there would be no balance.
    assert found["viscous_share"] > found["energy_error"]
    assert found["hourglass_share"] > 10 * found["energy_error"]
