"""Fixtures of the discovery's tests: a study in closed form, with the runs of its tables."""

from types import SimpleNamespace

import pytest
from hide import amplitudes
from make_tables import Generator
from network import Network
from plan import SEED
from specimens import design_of, shot_set
from toy_study import toy_sizes, write_runs, write_study


@pytest.fixture(scope="session")
def toy(tmp_path_factory):
    """`study` and `runs`: folders; `generator` of its tables, which takes no solver."""
    folder = tmp_path_factory.mktemp("toy")
    study = write_study(folder / "study")
    network = Network.from_file(study / "emulator.json")
    runs = folder / "runs"
    runs.mkdir()
    generator = Generator(study, runs)
    for variant in {table.variant for table in generator.tables()}:
        hidden = amplitudes(variant, study) if variant.effects else {}
        design = design_of(shot_set(variant.shot_set, SEED), hidden)
        write_runs(runs / f"{variant.name}.h5", design, toy_sizes(network, design))
    return SimpleNamespace(study=study, runs=runs, generator=generator, network=network)
