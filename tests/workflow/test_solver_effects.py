"""Effects on the solver's command line: the list, how they are set, and what is refused."""

import json
import subprocess

import h5py
import numpy as np
import pytest

FIELDS = {
    "name": str,
    "symbol": str,
    "equation": str,
    "unit": str,
    "lowest": (int, float),
    "highest": (int, float),
    "prior": dict,
    "signed": bool,
    "typical": (int, float),
    "acts_on": str,
    "geometries": list,
    "description": str,
    "source": str,
}
EFFECTS = [
    "anvil_friction",
    "thermal_softening",
    "hall_petch",
    "damage_softening",
    "phonon_drag",
    "taylor_quinney_shift",
    "back_stress",
    "rod_texture",
    "hard_skin",
    "forest_storage",
    "elastic_anvil",
    "oblique_impact",
    "dynamic_recovery",
    "velocity_bias",
]
SHORT = ["--velocity", 90, "--length-mm", 8, "--fidelity", "coarse", "--until-us", 4]


@pytest.fixture
def solver(program, tmp_path):
    """Runs the solver in an empty folder; returns the finished process."""

    def run(*arguments):
        return subprocess.run(
            [program("solver"), *map(str, arguments)],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=300,
        )

    return run


def answer(done):
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_the_list_has_every_effect_and_field(solver):
    listed = answer(solver("effects", "--json"))["effects"]
    assert [effect["name"] for effect in listed] == EFFECTS
    for effect in listed:
        assert set(effect) == set(FIELDS)
        for field, kind in FIELDS.items():
            assert isinstance(effect[field], kind), (effect["name"], field)
        assert effect["prior"]["kind"] in ("half_normal", "normal", "uniform")
        assert effect["prior"]["scale"] > 0
        assert effect["acts_on"] in ("material", "anvil", "initial_state", "impact")
        tilted = effect["name"] == "oblique_impact"
        assert effect["geometries"] == (["3d"] if tilted else ["axisymmetric", "3d"])
    table = solver("effects").stdout
    assert all(f"\n{name} " in table for name in EFFECTS)


def test_set_and_configuration_give_the_same_run(solver, tmp_path):
    (tmp_path / "rough.json").write_text(
        json.dumps({"fidelity": "coarse", "effects": {"anvil_friction": 0.2}})
    )
    by_file = answer(solver("run", "rough.json", *SHORT, "--json", "--out", "run.h5"))
    by_option = answer(solver("run", *SHORT, "--set", "anvil_friction=0.2", "--json"))
    without = answer(solver("run", *SHORT, "--json"))
    none = answer(solver("run", *SHORT, "--set", "anvil_friction=0", "--json"))
    assert by_file["sizes"] == by_option["sizes"] != without["sizes"] == none["sizes"]
    assert by_option["question"]["configuration"]["effects"] == {"anvil_friction": 0.2}
    with h5py.File(tmp_path / "run.h5") as file:
        for attribute in ("question", "provenance"):
            assert '"anvil_friction":0.2' in file.attrs[attribute].replace(" ", "")


def test_a_design_may_have_columns_of_effects(solver, tmp_path):
    names = ["velocity_m_s", "initial_diameter_mm", "length_to_diameter",
             "initial_temperature_K", "elastic_anvil"]  # fmt: skip
    with h5py.File(tmp_path / "design.h5", "w") as file:
        file.attrs["schema"] = "taylorcal/design/1"
        file["run_id"] = [0, 1]
        file["seed"] = [3, 3]
        file.create_dataset("shape", data=["uniform_cylinder"] * 2, dtype=h5py.string_dtype())
        rows = [[60, 6, 1, 300, 0], [60, 6, 1, 300, 0.5]]
        inputs = file.create_dataset("inputs", data=np.array(rows))
        inputs.attrs.create("names", names, dtype=h5py.string_dtype())
    (tmp_path / "solver.json").write_text('{"fidelity": "coarse"}')
    done = solver("batch", "design.h5", "--config", "solver.json", "--out", "database.h5")
    assert done.returncode == 0, done.stderr
    with h5py.File(tmp_path / "database.h5") as file:
        assert list(file["inputs"].attrs["names"]) == names
        length = file["outputs"][:, list(file["outputs"].attrs["names"]).index("final_length_mm")]
    # A pair of the same seed: the yielding anvil alone makes the second longer.
    assert length[1] > length[0]


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["anvil_frition=0.1"], ["anvil_frition", '"anvil_friction"', "solver effects"]),
        (["anvil_friction=0.7"], ["anvil_friction = 0.7", "0 to 0.5"]),
        (["anvil_friction=rough"], ["anvil_friction", "rough"]),
        (["oblique_impact=1"], ["oblique_impact", '"axisymmetric"', '"3d"']),
        (["hall_petch=0.1", "--set", "strength=j2"], ["hall_petch", '"j2"', '"dislocation"']),
    ],
)
def test_wrong_effects_are_refused_with_a_remedy(solver, arguments, words):
    done = solver("run", "--velocity", 90, "--set", *arguments)
    assert done.returncode == 1
    for word in words:
        assert word in done.stderr
