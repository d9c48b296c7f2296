"""The scorer, on diagnoses whose scores are known."""

import json
from dataclasses import replace

import pytest
from intervals import clopper_pearson
from judge import QUESTIONS, Case, answers, left_over
from score import main, markdown, read_cases, write_csv, answer_row


def diagnosis(
    kind="no effect supported", effects=(), shots=(), in_set=(), interval=(0.1, 0.3), per_unit=0.0
):
    names = ["anvil_friction", "back_stress", "velocity_bias"]
    return {
        "verdict": {
            "kind": kind,
            "effects": list(effects),
            "shots": list(shots),
            "flagged": kind != "no effect supported",
        },
        "adequacy": {"chi2": 90.0, "p_chi2": 0.5, "p_battery": 0.5, "p_score": 0.5},
        "candidates": [
            {
                "name": name,
                "in_set": name in in_set,
                "lower95": interval[0],
                "upper95": interval[1],
                "signal_per_unit": per_unit,
            }
            for name in names
        ],
    }


def truth(kind="null", effects=None, signal=0.0, **more):
    effects = effects or {}
    return {
        "kind": kind,
        "effects": effects,
        "signal_sd": signal,
        "strength": "",
        "material": "",
        "identifiability": {name: 0.6 for name in effects},
        "most_alike": {name: ["back_stress", 0.3] for name in effects},
        "parameters": {"hardening_coefficient": 3.0},
        "numerics": {"elements_across_radius": 6, "grains_per_point": 16},
        "corrupted": None,
        **more,
    }


def refit(with_theta, without_theta, with_chi2, without_chi2):
    def fit(value, chi2):
        parameters = {"hardening_coefficient": value}
        return {
            "parameters": parameters,
            "left_out_chi2": chi2,
            "left_out_in_turn_chi2": 4 * chi2,
        }

    return {
        "effect": "anvil_friction",
        "ranges": {"hardening_coefficient": [1.5, 4.5]},
        "information": [[4.0]],
        "with": fit(with_theta, with_chi2),
        "without": fit(without_theta, without_chi2),
    }


def score_of(cases, name):
    return next(answer for answer in answers(cases) if answer.question.name.startswith(name))


def friction(said, signal=7.0, **more):
    hidden = truth("effect", {"anvil_friction": 0.2}, signal, **more)
    return Case("t1", hidden, said)


RIGHT = diagnosis("effect", ["anvil_friction"], in_set=["anvil_friction"])


def test_false_flags_are_counted_on_nulls_alone():
    cases = [Case("a", truth(), diagnosis()), Case("b", truth(), RIGHT), friction(RIGHT)]
    answer = score_of(cases, "false flags")
    assert (answer.hits, answer.trials, answer.verdict) == (1, 2, "missed")
    assert answer.misses == ["b"]


def test_false_flags_of_metals_with_many_grains_are_counted_by_themselves():
    few = truth(numerics={"elements_across_radius": 7, "grains_per_point": 4})
    answer = score_of(
        [Case("a", truth(), diagnosis()), Case("b", few, RIGHT)], "false flags, tables"
    )
    assert (answer.hits, answer.trials, answer.verdict) == (0, 1, "met")


def test_only_visible_effects_must_be_flagged():
    cases = [friction(RIGHT), friction(diagnosis(), signal=5.9), friction(diagnosis())]
    answer = score_of(cases, "an effect of 6")
    assert (answer.hits, answer.trials) == (1, 2)


def test_an_effect_is_as_visible_as_all_errors_let_it():
    seen = friction(diagnosis(per_unit=35.0), signal=12.0)  # amplitude 0.2
    hidden_by_errors = friction(diagnosis(per_unit=25.0), signal=12.0)
    assert seen.signal_sd == pytest.approx(7) and seen.is_visible
    assert not hidden_by_errors.is_visible


def test_what_is_left_after_a_refit_is_the_excess_over_sound_tables():
    def with_chi2(case, chi2):
        return replace(case, diagnosis={**case.diagnosis, "adequacy": {"chi2": chi2}})

    nulls = [with_chi2(Case(f"n{i}", truth(), diagnosis()), 90 + 4 * i) for i in range(3)]
    seen = [with_chi2(replace(friction(RIGHT), id=f"e{i}"), 140 + 6 * i) for i in range(2)]
    found = {case.id: case for case in left_over(nulls + seen)}
    assert found["e0"].left_sd == found["e1"].left_sd == pytest.approx(7)
    assert found["n0"].left_sd == 0
    answer = score_of(list(found.values()), "an effect that leaves 6")
    assert (answer.hits, answer.trials) == (2, 2)


def test_what_resembles_a_listed_effect_is_asked_apart():
    said = diagnosis("outside the list")
    alone = Case("a", truth("outside", {"anvil_friction": 0.2}, 15), said)
    double = {"anvil_friction": ["back_stress", 0.95]}
    other = Case("b", truth("outside", {"anvil_friction": 0.2}, 15, most_alike=double), said)
    assert score_of([alone, other], "outside the list: says so (an effect unlike").trials == 1
    assert score_of([alone, other], "outside the list: says so (an effect that").trials == 1


def test_the_set_counts_members_beyond_the_named_ones():
    said = diagnosis("one of", ["back_stress"], in_set=["back_stress", "anvil_friction"])
    assert score_of([friction(said)], "flagged: the hidden").hits == 1
    without = diagnosis("one of", ["back_stress"], in_set=["back_stress"])
    assert score_of([friction(without)], "flagged: the hidden").hits == 0


def test_a_wrong_single_name_is_not_a_set():
    wrong = diagnosis("effect", ["back_stress"])
    assert score_of([friction(wrong)], "a wrong effect").hits == 1
    assert score_of([friction(diagnosis("one of", ["back_stress"]))], "a wrong effect").hits == 0


def test_confounded_means_absorbed_or_doubled():
    absorbed = friction(RIGHT, identifiability={"anvil_friction": 0.05})
    doubled = friction(
        diagnosis("one of", ["anvil_friction", "back_stress"]),
        most_alike={"anvil_friction": ["back_stress", 0.97]},
    )
    answer = score_of([absorbed, doubled, friction(RIGHT)], "a confounded effect")
    assert (answer.hits, answer.trials) == (1, 2)


def test_the_interval_covers_by_amplitude():
    low, high = friction(RIGHT), friction({**RIGHT, **diagnosis(interval=(0.3, 0.4))})
    answer = score_of([low, high], "the amplitude's")
    assert (answer.hits, answer.trials, answer.verdict) == (1, 2, "missed")


def test_adding_the_effect_is_judged_by_left_out_shots_and_parameters():
    better = refit(3.1, 3.9, with_chi2=20.0, without_chi2=40.0)
    worse = refit(3.9, 3.1, with_chi2=40.0, without_chi2=20.0)
    cases = [
        Case(str(n), friction(RIGHT).truth, RIGHT, fit) for n, fit in enumerate((better, worse))
    ]
    for name in ("error of every shot", "error of the fifth", "parameters"):
        name = f"the hidden effect added: {name}"
        answer = score_of(cases, name)
        assert (answer.hits, answer.trials) == (1, 2)


def test_parameters_are_judged_by_what_they_predict():
    fit = refit(3.1, 3.9, with_chi2=20.0, without_chi2=40.0)
    near, far = {"with": 4.0, "without": 30.0}, {"with": 30.0, "without": 4.0}
    cases = [
        Case(str(n), friction(RIGHT).truth, RIGHT, fit, distances=distances)
        for n, distances in enumerate((near, far, None))
    ]
    answer = score_of(cases, "the hidden effect added: parameters predict")
    assert (answer.hits, answer.trials) == (1, 2)


def test_a_bad_shot_is_found_by_its_name():
    hidden = truth("bad shot", corrupted={"id": "shot_07"})
    right = Case("a", hidden, diagnosis("bad data", shots=["shot_07"]))
    wrong = Case("b", hidden, diagnosis("bad data", shots=["shot_08"]))
    answer = score_of([right, wrong], "one wrong number")
    assert (answer.hits, answer.trials) == (1, 2)


def test_a_bias_may_be_named_but_not_taken_for_another_effect():
    named = Case("a", truth("bias"), diagnosis("effect", ["velocity_bias"]))
    mistaken = Case("b", truth("bias"), diagnosis("effect", ["back_stress"]))
    answer = score_of([named, mistaken], "a bias")
    assert (answer.hits, answer.trials) == (1, 2)


def test_questions_without_tables_are_not_answered():
    assert {answer.verdict for answer in answers([])} == {"not asked"}


@pytest.mark.parametrize(
    "hits, trials, lowest, highest",
    [(0, 100, 0.0, 0.03622), (5, 100, 0.01643, 0.11283), (100, 100, 0.96378, 1.0)],
)
def test_clopper_pearson_agrees_with_published_values(hits, trials, lowest, highest):
    assert clopper_pearson(hits, trials) == pytest.approx((lowest, highest), abs=2e-5)


def test_scores_are_written_for_people_and_programs(tmp_path, monkeypatch, capsys):
    tables, sealed, refits = (tmp_path / name for name in ("tables", "sealed", "refits"))
    cases = {"t001": (truth(), diagnosis()), "t002": (friction(RIGHT).truth, RIGHT)}
    for name, (hidden, said) in cases.items():
        (tables / name).mkdir(parents=True)
        (tables / name / "diagnosis.json").write_text(json.dumps(said))
        sealed.mkdir(exist_ok=True)
        (sealed / f"{name}.json").write_text(json.dumps(hidden))
    refits.mkdir()
    adding = {"t002": refit(3.1, 3.9, 20.0, 40.0)}
    (refits / "0.json").write_text(json.dumps(adding))
    monkeypatch.setattr("score.Network.from_file", lambda path: path)
    near = {"with": 4.0, "without": 30.0}
    monkeypatch.setattr("score.distances_to_truth", lambda *inputs: near)
    words = ["score", "--study", tmp_path, "--tables", tables, "--sealed", sealed]
    words += ["--refits", refits]
    monkeypatch.setattr("sys.argv", [str(word) for word in [*words, "--out", tmp_path / "out"]])
    main()
    assert "| a wrong effect is named alone | 0 of 1 | 0.0 % |" in capsys.readouterr().out
    scores = json.loads((tmp_path / "out" / "scores.json").read_text())
    assert len(scores) == len(QUESTIONS)
    assert (tmp_path / "out" / "discovery.png").stat().st_size > 10_000
    assert [case.distances for case in read_cases(None, tables, sealed, refits)] == [None, near]


def test_the_table_shows_what_was_not_asked(tmp_path):
    rows = [answer_row(answer) for answer in answers([])]
    assert "| 0 of 0 | - | - |" in markdown(rows, [])
    write_csv(tmp_path / "scores.csv", rows)
    assert (tmp_path / "scores.csv").read_text().startswith("question,")
