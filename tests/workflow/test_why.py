"""`taylorcal why` tells the stages that would run, and the cause in the study's own words."""

import subprocess

import pytest
from tiny_study import NEW_ROW, ROOT, use_own_workflow, use_stand_ins

from measurements import read_measurements
from why.causes import Causes
from why.changes import settings_changes, table_changes
from why.plan import Job, parsed_reasons
from why.records import recorded_settings
from why.runs import runs_words

SIZES = ["final_length_mm", "impact_diameter_mm"]


def why(workspace, root=ROOT) -> str:
    command = [root / "workflow" / "taylorcal", "why", "tiny"]
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    told = subprocess.run(command, cwd=workspace.folder, text=True, **streams)
    assert told.returncode == 0, told.stdout
    return told.stdout


def causes(told: str) -> dict[str, list[str]]:
    """The causes of each stage that was told."""
    parts = [part.splitlines() for part in told.strip().split("\n\n")[1:]]
    return {part[0]: [line.removeprefix("  because ") for line in part[1:]] for part in parts}


def test_with_nothing_changed_or_only_touched_there_is_nothing_to_do(copied):
    (copied.study / "measurements.csv").touch()
    told = why(copied)
    assert told.startswith("tiny: nothing to do")
    assert causes(told) == {}


def test_a_new_row_is_named_and_costs_no_run(copied):
    with (copied.study / "measurements.csv").open("a") as file:
        file.write(NEW_ROW)
    told = why(copied)
    assert told.startswith("tiny: 3 stages would run, without a run of the solver.")
    found = causes(told)
    assert found["sampling the posterior"] == ["the measurements changed: new shot b2 (line 6)"]
    assert "it follows from sampling the posterior" in found["comparing the model with the shots"]
    assert "writing the report" in found


def test_changed_settings_and_a_result_removed_are_named(copied):
    study = copied.study / "study.yaml"
    study.write_text(study.read_text().replace("runs: 24", "runs: 26"))
    text = study.read_text().replace("scope: per_lot", "scope: shared")
    study.write_text(text.replace("epochs: 60", "epochs: 61"))
    (copied.results / "report.html").unlink()
    told = why(copied)
    assert told.startswith("tiny: 7 stages would run, with 26 runs of the solver.")
    found = causes(told)
    (cause,) = found["choosing the runs of the database"]
    assert cause == "the database that study.yaml asks for changed: runs 24 -> 26"
    assert found["training the network"][0].endswith("changed: epochs 60 -> 61")
    scope = "parameters.rho_immobile_initial.scope per_lot -> shared"
    assert found["sampling the posterior"][0].endswith(scope)
    assert found["writing the report"][0] == "its result is not there: results/tiny/report.html"


def test_code_that_changed_is_named_also_where_a_stage_follows_anyway(copied):
    use_stand_ins(copied, dict.fromkeys(["emulator", "calibrate"], "0123456789abcdef"))
    use_own_workflow(copied)
    writer = copied.folder / "workflow" / "scripts" / "write_settings.py"
    writer.write_text(writer.read_text().replace("indent=2", "indent=4"))
    found = causes(why(copied, copied.folder))
    settings = "workflow/scripts/write_settings.py, or a module that it imports, changed"
    assert f"its settings are written anew: {settings}" in found["training the network"]
    assert "the program emulator changed" in found["training the network"]
    assert "the program calibrate changed" in found["sampling the posterior"]
    assert "choosing the runs of the database" not in found


def test_a_narrower_range_of_the_runs_is_told_with_its_remedy(copied):
    study = copied.study / "study.yaml"
    study.write_text(study.read_text().replace("lower: 1, upper: 5", "lower: 1.5, upper: 4"))
    changed, remedy = causes(why(copied))["choosing the runs of the database"]
    assert "parameters.hardening_coefficient.upper 5 -> 4" in changed
    assert remedy.endswith("with `hardening_coefficient: [1, 5]` in database.parameters")


def test_results_of_an_earlier_taylorcal_are_told_as_such(finished, tiny_study, monkeypatch):
    monkeypatch.chdir(finished.folder)
    told = Causes(tiny_study, finished.study / "measurements.csv", [], [])
    old = Job("train", {"study": "tiny"}, ["results/tiny/of_an_earlier_version.json"])
    assert told.own(old, "code", []) == []
    assert told.own(old, "settings", [])[0].startswith("an earlier taylorcal made it")
    new = Job("train", {"study": "tiny"}, ["results/tiny/emulator.json"])
    assert told.own(new, "code", []) == ["the rule train in workflow/rules changed"]


def test_a_bad_table_is_refused_before_anything_is_planned(fresh):
    with (fresh.study / "measurements.csv").open("a") as file:
        file.write(NEW_ROW.replace(",130,", ",fast,"))
    command = [ROOT / "workflow" / "taylorcal", "why", "tiny"]
    told = subprocess.run(command, cwd=fresh.folder, text=True, capture_output=True)
    assert told.returncode == 1
    assert "line 6: velocity_m_s = 'fast'" in told.stderr and "Traceback" not in told.stderr


def test_rows_are_compared_with_those_last_fitted(finished, tmp_path):
    table = tmp_path / "measurements.csv"
    text = (finished.study / "measurements.csv").read_text()
    comparison = finished.results / "comparison.json"
    table.write_text(text)
    assert table_changes(read_measurements(table), comparison, SIZES) == []
    text = text.replace("12.1,0.085", "12.2,0.085").replace("a3,first,validate", "a3,first,ignore")
    table.write_text(text.replace("b1,second", "b1,first"))
    assert table_changes(read_measurements(table), comparison, SIZES) == [
        "shot a3 is gone or left out",
        "shot a2 (line 3): final_length_mm 12.1 -> 12.2",
        "shot b1 (line 5): lot second -> first",
    ]


def test_settings_are_those_that_snakemake_recorded(finished, monkeypatch):
    monkeypatch.chdir(finished.folder)
    assert recorded_settings("results/tiny/design.h5")["runs"] == 24
    assert recorded_settings("results/tiny/config/train.json")["epochs"] == 60
    assert recorded_settings("results/tiny/chunks/0.h5") is None
    assert recorded_settings("results/tiny/nothing.h5") is None


@pytest.mark.parametrize(
    "before, after, expected",
    [
        ({"a": 1}, {"a": 1.0}, []),
        ({"a": {"b": 1}}, {"a": {"b": 2}}, ["a.b 1 -> 2"]),
        ({"a": 1}, {"b": 1}, ["a is gone", "b is new"]),
        ({"p": [{"name": "x", "k": 1}]}, {"p": [{"name": "x", "k": 2}]}, ["p.x.k 1 -> 2"]),
        ({"a": [1, 2]}, {"a": [1, 3]}, ["a [1, 2] -> [1, 3]"]),
    ],
)
def test_a_change_of_settings_is_named_by_its_key(before, after, expected):
    assert settings_changes(before, after) == expected


def test_reasons_are_sorted_and_unknown_ones_kept():
    text = "Missing output files: b.h5, a.h5; Code has changed since last execution; Full moon"
    assert parsed_reasons(text) == {"missing": ["a.h5", "b.h5"], "code": [], "Full moon": []}


def test_runs_in_the_journal_of_a_stopped_batch_are_told(tmp_path):
    out = tmp_path / "0.h5"
    (tmp_path / "0.h5.journal.jsonl").write_text("{}\n{}\n{}\n")
    stopped = Job("runs", {}, [str(out)], {"missing": [str(out)]}, 12)
    assert runs_words([stopped], []) == (
        "with 12 runs of the solver (2 of them are in the journal of a batch that was stopped)"
    )
    begun_anew = Job("runs", {}, [str(out)], {"follows": ["design.h5"]}, 12)
    assert runs_words([begun_anew], []) == "with 12 runs of the solver"
    confirmed = Job("confirmation_runs", {}, [str(out)], {})
    assert runs_words([confirmed], [{"use": "validate"}, {"use": "ignore"}]).startswith(
        "with 1 run "
    )
