"""The whole chain on a tiny study, with the real programs."""

import re
import time

import psutil
from tiny_study import NEW_ROW

from print_summary import summary

ALL = {"all", "report"}


def test_the_chain_gives_a_report(finished):
    page = (finished.results / "report.html").read_text()
    assert "Four shots" in page
    assert "Synthetic data" not in page
    for heading in ("Result", "Model against measurement", "Run costs", "Provenance"):
        assert heading in page
    assert not re.search(r'(src|href)="https?:', page), "the page must work without a network"
    assert len(list((finished.results / "plots").glob("*.png"))) >= 7


def test_the_summary_names_parameters_misfit_and_report(finished):
    text = summary(finished.results)
    assert "rho_immobile_initial[first]" in text
    assert "misfit, fitted" in text and "misfit, held back" in text
    assert "report.html" in text


def test_each_rule_leaves_a_log_and_a_benchmark(finished):
    logs = {path.stem for path in (finished.results / "logs").iterdir()}
    benchmarks = {path.stem for path in (finished.results / "benchmarks").iterdir()}
    stages = {"design", "runs_0", "runs_1", "merge", "train", "sample", "compare", "report"}
    assert stages <= logs
    assert stages <= benchmarks


def test_a_second_run_has_nothing_to_do(finished):
    assert finished.planned_rules() == set()
    done = finished.run()
    assert done.returncode == 0
    assert "Nothing to be done" in done.stdout


def test_a_new_row_reruns_only_sampling_comparing_and_the_report(copied):
    with (copied.study / "measurements.csv").open("a") as file:
        file.write(NEW_ROW)
    assert copied.planned_rules() == {"sample", "compare"} | ALL
    done = copied.run("--show-failed-logs")
    assert done.returncode == 0, done.stdout
    assert "b2" in (copied.results / "comparison.json").read_text()
    assert copied.planned_rules() == set()


def test_a_bad_table_stops_before_anything_runs(fresh):
    with (fresh.study / "measurements.csv").open("a") as file:
        file.write(NEW_ROW.replace(",130,", ",13,"))
    done = fresh.run("--dry-run")
    assert done.returncode != 0
    assert "line 6: b2: velocity_m_s = 13 is outside the database (100 to 210)" in done.stdout
    assert "Traceback" not in done.stdout


def test_a_killed_batch_goes_on_where_it_was(finished, fresh):
    chunk = "results/tiny/chunks/0.h5"
    journal = fresh.folder / f"{chunk}.journal.jsonl"
    process = psutil.Popen(fresh.command(chunk, "--quiet", "all"), cwd=fresh.folder)
    while process.poll() is None:
        if journal.exists() and len(journal.read_text().splitlines()) >= 4:
            for child in process.children(recursive=True):
                if child.name() == "solver":
                    child.kill()
            break
        time.sleep(0.005)
    assert process.wait() != 0, "the batch ended before it could be killed"
    assert journal.exists() and not (fresh.folder / chunk).exists()
    assert fresh.run(chunk).returncode == 0
    assert "in the journal already" in (fresh.results / "logs" / "runs_0.log").read_text()
    assert not journal.exists()
    whole = (finished.folder / chunk).read_bytes()
    assert (fresh.folder / chunk).read_bytes() == whole, "a resumed batch gives the same bytes"
