"""`taylorcal manifest`: a study's results as a research object."""

import hashlib
import json
import platform
import re
import subprocess
import sys
from pathlib import Path

import pytest
from tiny_study import STUDY, copy_workspace

from crate.manifest import write_manifest
from job_log import job_record
from json_file import read_json
from study import load_study


@pytest.fixture(scope="module")
def crate(finished, tmp_path_factory):
    workspace = copy_workspace(finished, tmp_path_factory.mktemp("crate") / "copy")
    command = [sys.executable, "workflow/taylorcal", "manifest", STUDY]
    done = subprocess.run(command, cwd=workspace.folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    path = workspace.folder / done.stdout.strip()
    assert path == workspace.results / "ro-crate-metadata.json"
    return path


@pytest.fixture(scope="module")
def entities(crate):
    content = json.loads(crate.read_text())
    assert content["@context"] == "https://w3id.org/ro/crate/1.1/context"
    by_id = {entity["@id"]: entity for entity in content["@graph"]}
    assert len(by_id) == len(content["@graph"]), "no two entities have one id"
    return by_id


def of_type(entities, kind):
    return [entity for entity in entities.values() if entity["@type"] == kind]


def references(value):
    """All ids that an entity points to."""
    if isinstance(value, dict):
        if set(value) == {"@id"}:
            yield value["@id"]
        else:
            for inner in value.values():
                yield from references(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from references(inner)


def test_the_descriptor_and_root_are_those_of_ro_crate(entities):
    descriptor, root = entities["ro-crate-metadata.json"], entities["./"]
    assert descriptor["@type"] == "CreativeWork"
    assert descriptor["conformsTo"] == {"@id": "https://w3id.org/ro/crate/1.1"}
    assert descriptor["about"] == {"@id": "./"}
    assert root["@type"] == "Dataset" and root["name"] == "Four shots"
    assert re.fullmatch(r"\d{4}-\d\d-\d\d", root["datePublished"])
    assert root["description"] and root["license"]
    files = {entity["@id"] for entity in of_type(entities, "File")}
    assert {part["@id"] for part in root["hasPart"]} == files


def test_every_reference_leads_to_an_entity(entities):
    outside = {"https://w3id.org/ro/crate/1.1"}
    for entity in entities.values():
        for target in references({key: v for key, v in entity.items() if key != "@id"}):
            assert target in entities or target in outside, target


def test_files_are_there_with_size_and_digest(crate, entities):
    files = of_type(entities, "File")
    names = {entity["@id"] for entity in files}
    wanted = {"database.h5", "emulator.json", "posterior.h5", "comparison.json", "report.html"}
    assert wanted | {"study/study.yaml", "study/measurements.csv", "config/train.json"} <= names
    for entity in files:
        content = (crate.parent / entity["@id"]).read_bytes()
        assert entity["contentSize"] == str(len(content))
        assert entity["sha256"] == hashlib.sha256(content).hexdigest()


def test_each_result_leads_to_program_inputs_seed_and_cost(entities):
    jobs = {}
    for job in of_type(entities, "CreateAction"):
        jobs |= {result["@id"]: job for result in job["result"]}
    made_from = {
        "emulator.json": {"database.h5", "config/train.json"},
        "posterior.h5": {"emulator.json", "study/measurements.csv", "config/calibrate.json"},
        "comparison.json": {"posterior.h5", "emulator.json"},
    }
    programs = {"emulator.json": "emulator", "posterior.h5": "calibrate", "database.h5": "solver"}
    for name, inputs in made_from.items():
        assert inputs <= {item["@id"] for item in jobs[name]["object"]}
        assert jobs[name]["startTime"] <= jobs[name]["endTime"]
        costs = {item["name"]: item["value"] for item in jobs[name]["additionalProperty"]}
        assert costs["wall seconds"] > 0
    for name, program in programs.items():
        (used,) = (entities[item["@id"]] for item in jobs[name]["instrument"])
        assert used["name"] == f"taylorcal {program}"
        assert re.fullmatch(r"code [0-9a-f]{16}", used["softwareVersion"])
        facts = {item["name"] for item in entities[name]["additionalProperty"]}
        assert {"version", "seed", "configuration", "processor", "compiler"} <= facts


SMALL_DIAGNOSIS = """
diagnosis:
  points_per_shape: 4
  candidates: [anvil_friction]
  constants: []
"""
# Programs by the results that they make; the report and the page are drawn by scripts.
MADE_BY = {
    "database.h5": "solver",
    "emulator.json": "emulator",
    "posterior.h5": "calibrate",
    "comparison.json": "calibrate",
    "signatures.h5": "solver",
    "diagnosis.json": "calibrate",
    "next_experiment.json": "calibrate",
    "report.html": "make_report.py",
    "diagnosis.html": "make_diagnosis_page.py",
}


def test_each_result_has_its_machine_seconds_inputs_version_and_settings(
    finished, tmp_path, monkeypatch
):
    workspace = copy_workspace(finished, tmp_path / "copy")
    with (workspace.study / "study.yaml").open("a") as file:
        file.write(SMALL_DIAGNOSIS)
    done = workspace.run("--show-failed-logs", "all", f"results/{STUDY}/diagnosis.html")
    assert done.returncode == 0, done.stdout
    monkeypatch.chdir(workspace.folder)
    study, results = Path("experiments") / STUDY, Path("results") / STUDY
    graph = read_json(write_manifest(load_study(STUDY), study, results))
    by_id = {entity["@id"]: entity for entity in graph["@graph"]}
    jobs = of_type(by_id, "CreateAction")
    for name, program in MADE_BY.items():
        made = [job for job in jobs if {"@id": name} in job["result"]]
        assert made, name
        for job in made:
            facts = {item["name"]: item["value"] for item in job["additionalProperty"]}
            assert facts["machine"] == platform.node(), name
            assert facts["wall seconds"] > 0 and facts["CPU seconds"] > 0, name
            assert all(
                re.fullmatch("[0-9a-f]{64}", by_id[i["@id"]]["sha256"]) for i in job["object"]
            )
        programs = {by_id[item["@id"]]["name"] for job in made for item in job["instrument"]}
        assert programs == {f"taylorcal {program}"}
        if name.endswith(".html"):
            continue
        facts = {item["name"] for item in by_id[name]["additionalProperty"]}
        assert {"version", "seed", "configuration", "processor"} <= facts, name
    runs = [job for job in jobs if job["name"] == "runs"]
    assert len(runs) == 2, "the chunks' own costs are told beside that of joining them"


def test_the_machine_is_in_no_result(finished):
    """Same inputs, same bytes: it stands in the logs alone."""
    assert job_record(finished.results / "logs" / "sample.log").host == platform.node()
    for name in ("database.h5", "emulator.json", "posterior.h5", "comparison.json"):
        assert f'"{platform.node()}"'.encode() not in (finished.results / name).read_bytes()


def test_the_report_ends_with_digests_and_costs(finished):
    page = (finished.results / "report.html").read_text()
    end = page[page.index('<section id="provenance">') :]
    for name in ("database.h5", "emulator.json", "posterior.h5", "comparison.json"):
        assert hashlib.sha256((finished.results / name).read_bytes()).hexdigest() in end
    assert "made from measurements.csv" in end and "wall and CPU seconds" in end
    assert "computed on" in end and platform.node() in end


def test_a_study_without_results_is_refused(fresh):
    command = [sys.executable, "workflow/taylorcal", "manifest", STUDY]
    done = subprocess.run(command, cwd=fresh.folder, capture_output=True, text=True)
    assert done.returncode == 1 and "no results yet" in done.stderr
