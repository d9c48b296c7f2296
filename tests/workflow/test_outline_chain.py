"""The whole chain with a measured outline, with the real programs."""

import json

import pytest
from outlined_study import OUTLINE, outlined_study

from size_kinds import OUTLINE_SCORES

SCORING = {"score_measurements", "sample", "compare", "report", "all"}


@pytest.fixture
def outlined(copied):
    """The finished study, to which an outline is added now."""
    outlined_study(copied.study)
    return copied


def test_outlines_join_a_finished_study(outlined):
    added = {"outline_basis", "score_database", "train", "settings"} | SCORING
    assert outlined.planned_rules() == added, "the runs are there already"
    done = outlined.run("--show-failed-logs")
    assert done.returncode == 0, done.stdout
    comparison = json.loads((outlined.results / "comparison.json").read_text())
    sizes = {shot["id"]: {cell["size"] for cell in shot["sizes"]} for shot in comparison["shots"]}
    assert sizes["a1"] & set(OUTLINE_SCORES)
    assert not sizes["a2"] & set(OUTLINE_SCORES)
    assert (outlined.results / "plots" / "outlines.png").stat().st_size > 5000
    page = (outlined.results / "report.html").read_text()
    assert "Components of the outline" in page
    assert outlined.planned_rules() == set()

    # Another dot costs no run and no training.
    (outlined.study / "a1.csv").write_text(OUTLINE.replace("2,4.8", "2,4.75"))
    assert outlined.planned_rules() == SCORING


def test_a_bad_outline_stops_before_anything_runs(outlined):
    (outlined.study / "a1.csv").write_text(OUTLINE.replace("2,4.8", "0.5,4.8"))
    done = outlined.run("--dry-run")
    assert done.returncode != 0
    assert "a1.csv, line 4: height_mm = 0.5 after 1" in done.stdout
    assert "Traceback" not in done.stdout
