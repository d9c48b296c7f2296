"""What a program would refuse after its older results are gone is refused by the study's checks."""

import pytest
from tiny_study import ROOT, STUDY_YAML, write_study

from effects import check_material, solver_list
from input_errors import InputError
from schema_check import load_schema
from shape_names import ENDS, HEADS, shape_problem
from study import load_study, read_study

MATERIAL = "  fidelity: coarse\n"
LENGTHS = "[7, 8]\n  length_to_diameter: [1.5, 5]"
NETWORK = "  batch_sizes: [8]\n"
SHARED = STUDY_YAML.replace("scope: per_lot", "scope: shared")


def refusal(tmp_path, text: str) -> str:
    path = write_study(tmp_path / "tiny", text) / "study.yaml"
    with pytest.raises(InputError) as error:
        check_material(read_study(path), path)
    return str(error.value)


def check(tmp_path, text: str, expected: list[str]) -> None:
    message = refusal(tmp_path, text)
    for part in ["study.yaml, line ", *expected]:
        assert part in message


@pytest.mark.parametrize(
    "old, new, expected",
    [
        ("lower: 1,", "lower: .nan,", ["hardening_coefficient.lower = nan (expected a finite"]),
        ("upper: 5,", "upper: .inf,", ["hardening_coefficient.upper = inf (expected a finite"]),
        ("[100, 210]", "[.nan, 210]", ["line 16: database.velocity_m_s.0 = nan"]),
        (NETWORK, NETWORK + "  validation_fraction: .nan\n", ["validation_fraction = nan"]),
        (NETWORK, "  batch_sizes: [100000]\n", ["batch_sizes.0 = 100000", "at most 65536"]),
        ("upper: 5,", "upper: 50,", ["hardening_coefficient.upper = 50 (expected at most 10"]),
        ("lower: 1.0e+12", "lower: 1.0e+9", ["rho_immobile_initial.lower", "1/m2"]),
        ("[100, 210]", "[0.5, 210]", ["velocity_m_s.0 = 0.5 (expected at least 1)"]),
        ("[1.5, 5]\n", "[0.5, 5]\n", []),
        (LENGTHS, "[7, 100]\n  length_to_diameter: [1.5, 20]", ["specimens 10.5 to 2000 mm"]),
        ("[7, 8]", "[7, 100]", []),
        ("runs: 24", "runs: 24.0", ["database.runs = 24.0 (expected a whole number)"]),
        ("[uniform_cylinder]", "[reduced_head_9mm]", ["shapes.0 = 'reduced_head_9mm'", "7.2 mm"]),
        ("[uniform_cylinder]", "[reduced_head_0mm]", ["the end's diameter is 0 mm"]),
        (
            "  chunks: 2",
            "  chunks: 2\n  further: [{ runs: 4, shapes: [truncated_cone_4mm_by_39mm] }]",
            ["line 15: database.further.0.shapes.0", "the head's length is 39 mm"],
        ),
        (MATERIAL, MATERIAL + "  material: { poisson_ratio: .nan }\n", ["poisson_ratio = nan"]),
        (
            MATERIAL,
            MATERIAL + "  material: { hardening_coefficient: 2 }\n",
            ["line 11: solver.material.hardening_coefficient is calibrated"],
        ),
    ],
)
def test_values_beyond_the_programs_are_refused(tmp_path, old, new, expected):
    assert old in STUDY_YAML
    text = STUDY_YAML.replace(old, new)
    if expected:
        check(tmp_path, text, expected)
    else:
        read_study(write_study(tmp_path / "tiny", text) / "study.yaml")


@pytest.mark.parametrize(
    "lines, expected",
    [
        ("velocity_sd_relative: .nan", ["velocity_sd_relative = nan"]),
        ("unexplained_spread: { prior_scale: 0.02, grid: [0.05, 0.01] }", ["grid = [0.05, 0.01]"]),
        ("unexplained_spread: { prior_scale: 0.02, grid: [0.01, 0.05] }", ["rising values from 0"]),
        ("unexplained_spread: { prior_scale: 0.02, grid: [0, .nan] }", ["grid.1 = nan"]),
        ("draw_sequence: sobol", ["draw_sequence = sobol", "draws_from: prior"]),
        ("network_errors: common\n  likelihood: paper", ["network_errors = common"]),
        ("network_errors: common\n  draws_from: prior", ["network_errors = common"]),
    ],
)
def test_settings_of_the_sampler_that_do_not_fit_are_refused(tmp_path, lines, expected):
    check(tmp_path, f"{SHARED}  {lines}\n", ["calibration.", *expected])


def test_plain_draws_are_for_few_shared_parameters(tmp_path):
    line = "  draws_from: prior\n"
    check(tmp_path, STUDY_YAML + line, ["draws_from = prior", "rho_immobile_initial per_lot"])
    effects = "effects: [anvil_friction, phonon_drag, hard_skin]\n"
    check(tmp_path, SHARED + line + effects, ["found 5, effects included"])
    read_study(write_study(tmp_path / "tiny", SHARED + line) / "study.yaml")


def test_an_unknown_constant_of_a_diagnosis_is_refused_with_its_line(tmp_path):
    text = STUDY_YAML + "diagnosis: { constants: [poison_ratio] }\n"
    check(tmp_path, text, ["line 33: diagnosis.constants.0", "Did you mean 'poisson_ratio'?"])


@pytest.mark.parametrize(
    "material, expected",
    [
        ("poisson_ratio: 0.7", ["poisson_ratio = 0.7 (expected 0 to 0.49)"]),
        ("poison_ratio: 0.3", ["line 11: solver.material.poison_ratio", "'poisson_ratio'"]),
        ("foo: 1", ["solver.material.foo is not a constant"]),
        (
            "strength: johnson_cook, jc_melting_temperature: 301, reference_temperature: 400",
            ["jc_melting_temperature = 301 (expected above reference_temperature = 400 K)"],
        ),
    ],
)
def test_constants_are_those_of_the_solver(tmp_path, program, monkeypatch, material, expected):
    known = solver_list("parameters", program("solver"))
    monkeypatch.setattr("effects.solver_list", lambda what: known)
    text = STUDY_YAML.replace(MATERIAL, f"{MATERIAL}  material: {{ {material} }}\n")
    check(tmp_path, text, expected)


def test_the_schema_has_the_solvers_own_ranges(program):
    known = solver_list("parameters", program("solver"))
    schema = load_schema("study")
    for name, entry in schema["properties"]["parameters"]["properties"].items():
        kind = schema["$defs"][entry["$ref"].rsplit("/", 1)[1]]["properties"]
        covered = schema["properties"]["database"]["properties"]["parameters"]["properties"]
        for limits in (kind["lower"], kind["upper"], covered[name]["items"]):
            solver = (known[name]["lowest"], known[name]["highest"])
            assert (limits["minimum"], limits["maximum"]) == solver


def test_shapes_have_the_solvers_own_limits():
    source = (ROOT / "solver" / "specimen" / "shape_names.cpp").read_text()
    assert "narrowest_end = {}, widest_end = {};".format(*ENDS) in source
    assert "shortest_head = {}, longest_head = {};".format(*HEADS) in source
    assert not shape_problem("truncated_cone_2.5mm_by_9mm_of_7.6mm_by_25.4mm")
    assert "above 0" in shape_problem("reduced_head_3mm_of_0mm_by_25mm")


@pytest.mark.parametrize("study", ["experiments/copper_measured", "experiments/paper_design"])
@pytest.mark.parametrize("shape", ["reduced_head_4mm", "truncated_cone"])
def test_what_was_valid_stays_valid(study, shape):
    assert load_study(study.partition("/")[2], ROOT / "experiments")
    assert not shape_problem(shape)


@pytest.mark.parametrize(
    "old, new, expected",
    [
        ("title: Four shots", "title: !see", ["line 1: is not YAML"]),
        ("material: copper", "material: copper\n? [a, b]\n: 2", ["line 3: a key is a list"]),
        ("material: copper", "material: &x [*x]", ["line 2: material.0 holds itself"]),
        ("runs: 24", "runs: !!int many", ["is not YAML"]),
        ("title: Four shots", "title: 2020", ["title = 2020 (expected a text). Put it in quotes."]),
    ],
)
def test_odd_yaml_is_refused_with_its_line(tmp_path, old, new, expected):
    message = refusal(tmp_path, STUDY_YAML.replace(old, new, 1))
    for part in ["study.yaml", *expected]:
        assert part in message


def test_a_date_is_text(tmp_path):
    text = STUDY_YAML.replace("Four shots", "2020-02-30")
    study = read_study(write_study(tmp_path / "tiny", text) / "study.yaml")
    assert study["title"] == "2020-02-30"


def test_patterns_are_told_in_words(tmp_path):
    message = refusal(tmp_path, STUDY_YAML + "effects: [Hard skin]\n")
    assert "effects.0 = 'Hard skin' (expected small letters a to z, digits and _" in message
