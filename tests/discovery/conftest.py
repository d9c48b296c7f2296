"""Fixtures of the discovery's tests: a study in closed form, with the runs of its tables."""

import shutil
from types import SimpleNamespace

import pytest
from hide import amplitudes
from make_tables import Generator
from network import Network
from plan import SEED, SETS, metal_name
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
    signatures = folder / "signatures"
    for index in range(SETS):
        # Effects of this study are the same for all metals.
        (signatures / metal_name(index)).mkdir(parents=True)
        shutil.copy(study / "signatures.h5", signatures / metal_name(index))
    generator = Generator(study, runs, signatures)
    for variant in {table.variant for table in generator.tables()}:
        hidden = amplitudes(variant, study, study / "signatures.h5") if variant.effects else {}
        design = design_of(shot_set(variant.shot_set, SEED), hidden)
        write_runs(runs / f"{variant.name}.h5", design, toy_sizes(network, design))
    return SimpleNamespace(
        study=study, runs=runs, signatures=signatures, generator=generator, network=network
    )
