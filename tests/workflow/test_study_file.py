"""A broken study.yaml is refused with its place, its value and the remedy."""

import pytest
from tiny_study import ROOT, STUDY_YAML, write_study

from input_errors import InputError
from measurements import check_against_study, read_measurements
from schema_check import load_schema
from study import calibrate_settings, design_settings, load_study, read_study, train_settings


def refusal(tmp_path, old: str, new: str) -> str:
    assert old in STUDY_YAML
    folder = write_study(tmp_path / "tiny", STUDY_YAML.replace(old, new))
    with pytest.raises(InputError) as error:
        read_study(folder / "study.yaml")
    return str(error.value)


@pytest.mark.parametrize(
    "old, new, expected",
    [
        ("  runs: 24", "  run: 24", ["line 13: database.run ", "Did you mean 'runs'?"]),
        (
            "velocity_m_s: [100, 210]",
            "velocity_km_s: [0.1, 0.21]",
            ["database.velocity_km_s", "unit", "Did you mean 'velocity_m_s'?"],
        ),
        ("scope: per_lot", "scope: per_batch", ["scope = 'per_batch'", "Did you mean 'per_lot'?"]),
        ("fidelity: coarse", "fidelity: corse", ["solver.fidelity = 'corse'", "'coarse'"]),
        ("shapes: [uniform_cylinder]", "shapes: [cylinder]", ["shapes.0 = 'cylinder'"]),
        ("upper: 5", "upper: -5", ["hardening_coefficient.upper = -5", "at least 0"]),
        ("lower: 1.0e+12", "lower: 1e12", ["= '1e12'", "expected a number", "write 1.0e+12"]),
        ("epochs: 60", "epochs: 60.5", ["emulator.epochs = 60.5", "a whole number"]),
        ("[100, 210]", "[210, 100]", ["velocity_m_s = [210, 100]", "lowest value first"]),
        ("[100, 210]", "[100, 210, 300]", ["a list with a length of at most 2"]),
        ("upper: 5,", "upper: 1,", ["hardening_coefficient has the range 1 to 1"]),
        (
            "  runs: 24",
            "  runs: 24\n  parameters: { hardening_coefficient: [2, 6] }",
            ["database.parameters.hardening_coefficient = [2, 6]", "1 to 5", "Widen it"],
        ),
        (
            "  runs: 24",
            "  runs: 24\n  parameters: { immobilization_velocity: [0, 5] }",
            ["database.parameters.immobilization_velocity is not calibrated"],
        ),
        (
            "  runs: 24",
            "  runs: 24\n  parameters: { rho_immobile_initial: [0, 1.0e+14] }",
            ["database.parameters.rho_immobile_initial"],
        ),
        ("chunks: 2", "chunks: 25", ["database.chunks is more than `runs`"]),
        ("  draws: 2000\n", "", ["calibration.draws is missing"]),
        ("title: Four shots\n", "", ["title is missing"]),
        ("material: copper", "material: copper\nmaterial: steel", ["line 3", "given twice"]),
        ("material: copper", "material: copper\nsynthetic: true", ["synthetic_note is missing"]),
        ("material: copper", "material: [copper", ["is not YAML"]),
        (
            "fit_sizes: [final_length_mm,",
            "fit_sizes: [head_length_mm,",
            ["calibration.fit_sizes", "'head_length_mm'", "emulator.outputs"],
        ),
    ],
)
def test_a_broken_study_is_refused(tmp_path, old, new, expected):
    message = refusal(tmp_path, old, new)
    for part in ["study.yaml", *expected]:
        assert part in message


def test_every_fault_is_told_at_once(tmp_path):
    text = STUDY_YAML.replace("runs: 24", "runs: 0").replace("seed", "sed")
    folder = write_study(tmp_path / "tiny", text.replace("epochs: 60", "epoch: 60"))
    with pytest.raises(InputError) as error:
        read_study(folder / "study.yaml")
    assert str(error.value).count("study.yaml, line") == 3


def test_an_unknown_study_names_the_known_ones(tmp_path):
    write_study(tmp_path / "copper")
    with pytest.raises(InputError, match="Did you mean 'copper'"):
        load_study("coper", tmp_path)
    with pytest.raises(InputError, match="Known here: copper"):
        load_study("steel", tmp_path)


@pytest.mark.parametrize("name", ["copper_measured", "paper_design"])
def test_the_studies_of_the_repository_are_valid(name):
    study = load_study(name, ROOT / "experiments")
    table = ROOT / "experiments" / name / study["measurements"]
    check_against_study(read_measurements(table), study, table)


def test_defaults_are_filled_in(tiny_study):
    assert tiny_study["calibration"]["velocity_sd_relative"] == 0.01
    assert tiny_study["solver"]["material"]["strength"] == "dislocation"
    assert tiny_study["parameters"]["hardening_coefficient"]["scope"] == "shared"


def test_the_design_does_not_see_the_sampler_or_the_scope(tiny_study):
    before = design_settings(tiny_study)
    tiny_study["calibration"]["draws"] = 7
    tiny_study["emulator"]["epochs"] = 7
    tiny_study["parameters"]["rho_immobile_initial"]["scope"] = "shared"
    assert design_settings(tiny_study) == before


def test_train_settings_divide_sizes_by_the_specimen(tiny_study):
    settings = train_settings(tiny_study)
    assert settings["category"] is None
    assert {"name": "rho_immobile_initial", "transform": "log10"} in settings["inputs"]
    assert {"name": "hardening_coefficient", "transform": "square_root"} in settings["inputs"]
    length, diameter = settings["outputs"]
    assert length["divide_by"] == ["initial_diameter_mm", "length_to_diameter"]
    assert diameter["divide_by"] == ["initial_diameter_mm"]
    assert calibrate_settings(tiny_study)["parameters"][0]["scope"] == "per_lot"


def properties(schema: dict):
    for name, sub in schema.get("properties", {}).items():
        yield name, sub
        yield from properties(sub)
    for sub in schema.get("$defs", {}).values():
        yield from properties(sub)


@pytest.mark.parametrize("name", ["study", "measurements"])
def test_each_property_is_described_with_its_unit_and_bounds(name):
    schema = load_schema(name)
    for key, sub in properties(schema):
        if "$ref" in sub and set(sub) == {"$ref"}:
            continue
        group = sub.get("type") == "object" or "$ref" in sub
        assert sub.get("description"), key
        assert "unit" in sub or group, key
        if sub.get("type") in ("number", "integer"):
            assert {"minimum", "exclusiveMinimum"} & set(sub), key
            assert "maximum" in sub, key
