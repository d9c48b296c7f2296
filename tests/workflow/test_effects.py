"""Effects of a study: checked, and seen by the stages of their revision only."""

import pytest
from stub_lists import EFFECTS, effect
from tiny_study import STUDY_YAML, write_study

from candidates import candidates, typical_amplitudes
from effects import check_effects, solver_list
from input_errors import InputError
from make_design import design
from revisions import home_of, homes_of, previous_home, revision_ids, split_home
from study import STAGE_SETTINGS, at_revision, chunk_count, design_settings, read_study


def with_lines(lines: str) -> str:
    return STUDY_YAML.replace("solver:\n", f"{lines}\nsolver:\n", 1)


def refusal(tmp_path, lines: str) -> str:
    path = write_study(tmp_path / "tiny", with_lines(lines)) / "study.yaml"
    with pytest.raises(InputError) as error:
        check_effects(read_study(path), path, EFFECTS)
    return str(error.value)


@pytest.mark.parametrize(
    "lines, expected",
    [
        ("effects: [anvil_fricton]", ["line 8: effects has", "Did you mean 'anvil_friction'?"]),
        ("effects:\n  - phonon_drag\n  - rust", ["line 10: effects has 'rust'", "Known here"]),
        ("effects: [phonon_drag, phonon_drag]", ["effects holds 'phonon_drag' twice"]),
        ("effects: phonon_drag", ["effects = 'phonon_drag' (expected a list)"]),
        ("effects: [oblique_impact]", ["geometry axisymmetric does not", "geometry: 3d"]),
        ("diagnosis: { candidates: [frost] }", ["line 8: diagnosis.candidates has 'frost'"]),
        ("diagnosis: { candidates: some }", ["diagnosis.candidates = 'some'"]),
        ("diagnosis: { points_per_shape: 1 }", ["points_per_shape = 1", "at least 4 shots"]),
    ],
)
def test_wrong_effects_are_refused(tmp_path, lines, expected):
    message = refusal(tmp_path, lines)
    for part in ["study.yaml", *expected]:
        assert part in message


def test_a_calibrated_parameter_is_not_an_effect_too(tmp_path):
    path = write_study(tmp_path / "tiny", with_lines("effects: [x]")) / "study.yaml"
    study = read_study(path)
    study["effects"] = ["hardening_coefficient"]
    with pytest.raises(InputError, match="calibrated already"):
        check_effects(study, path, {"hardening_coefficient": effect("hardening_coefficient")})


def test_revisions_are_the_prefixes_of_the_list():
    assert revision_ids(["a", "b"]) == ["base", "a", "a+b"]
    assert homes_of("tiny", ["a", "b"])[-1] == "tiny/revisions/a+b"
    assert split_home("tiny/revisions/a+b") == ("tiny", ["a", "b"])
    assert split_home("tiny") == ("tiny", [])
    assert previous_home("tiny/revisions/a+b") == home_of("tiny", ["a"])
    assert previous_home("tiny/revisions/a") == "tiny"
    assert previous_home("tiny") is None


def test_the_base_does_not_see_the_effects(tiny_study):
    before = {name: cut(tiny_study) for name, cut in STAGE_SETTINGS.items()}
    tiny_study["effects"] = ["anvil_friction"]
    assert {name: cut(tiny_study) for name, cut in STAGE_SETTINGS.items()} == before


@pytest.fixture
def revised(tiny_study):
    return at_revision(tiny_study, [EFFECTS["anvil_friction"], EFFECTS["phonon_drag"]])


def test_a_revision_runs_trains_and_samples_with_the_amplitudes(revised):
    assert revised["database"]["runs_per_effect"] == 6
    train = STAGE_SETTINGS["train"](revised)
    assert [entry["name"] for entry in train["inputs"]][-2:] == ["anvil_friction", "phonon_drag"]
    assert train["epochs"] == 20
    assert "epochs_of_revision" not in train
    friction, drag = STAGE_SETTINGS["calibrate"](revised)["parameters"][-2:]
    assert friction == {
        "name": "anvil_friction",
        "lower": 0.0,
        "upper": 0.5,
        "prior": "half_normal",
        "scale": 0.15,
        "scope": "shared",
    }
    assert drag["lower"] == -0.8
    assert STAGE_SETTINGS["solver"](revised) == revised["solver"]
    assert STAGE_SETTINGS["report"](revised)["parameters"]["phonon_drag"]["upper"] == 2.0


def test_a_uniform_prior_has_no_scale(tiny_study):
    prior = {"kind": "uniform", "scale": 1}
    study = at_revision(tiny_study, [effect("hard_skin", prior=prior)])
    assert "scale" not in STAGE_SETTINGS["calibrate"](study)["parameters"][-1]


def test_the_new_runs_vary_every_amplitude_and_go_on_counting(revised, tiny_study):
    revised["database"]["runs_per_effect"] = 64
    made = design(design_settings(revised))
    assert list(made["run_id"]) == list(range(24 + 64, 24 + 128))
    assert made["names"][-2:] == ["anvil_friction", "phonon_drag"]
    assert made["inputs"][:, -2].min() == 0 and made["inputs"][:, -2].max() == 0.5
    assert made["inputs"][:, -1].min() == -0.8
    assert made["inputs"][:, -1].max() == pytest.approx(2)
    assert 20 < (made["inputs"][:, -1] > 0.6).sum() < 44
    base = design(design_settings(tiny_study))
    assert not set(made["seed"]) & set(base["seed"])
    assert chunk_count({**revised, "database": {**revised["database"], "chunks": 90}}) == 64


def test_the_solvers_own_list_serves_every_stage(tiny_study, program):
    effects = solver_list("effects", program("solver"))
    parameters = solver_list("parameters", program("solver"))
    assert {"anvil_friction", "thermal_softening", "oblique_impact"} <= set(effects)
    for name, entry in effects.items():
        study = at_revision(tiny_study, [entry])
        amplitude = STAGE_SETTINGS["calibrate"](study)["parameters"][-1]
        assert amplitude["lower"] <= 0 <= amplitude["upper"], name
        assert amplitude["lower"] < 0 or amplitude["prior"] != "normal", name
        assert amplitude["lower"] == 0 or amplitude["prior"] != "half_normal", name
    axisymmetric = [name for name, e in effects.items() if "axisymmetric" in e["geometries"]]
    found = {entry["name"]: entry for entry in candidates(tiny_study, effects, parameters)}
    assert [name for name, e in found.items() if e["kind"] == "effect"] == axisymmetric
    for name, typical in typical_amplitudes(tiny_study, effects).items():
        entry = found[name]
        assert entry["lowest"] <= entry["base"] <= entry["highest"], name
        assert entry["base"] < entry["base"] + typical <= entry["highest"], name
