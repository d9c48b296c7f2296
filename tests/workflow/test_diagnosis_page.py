"""The diagnosis page, drawn from examples of what the stages write."""

import html
import json
import re
from pathlib import Path

import pytest
from tiny_study import ROOT

from input_errors import InputError
from make_diagnosis_page import write_diagnosis
from report import verdict
from report.diagnosis_results import load_diagnosis

DATA = Path(__file__).parent / "data"
TEMPLATES = ROOT / "workflow" / "report"
REVISIONS = ("base", "anvil_friction")


def inputs(name="diagnosis", **others):
    """Example files; `name` is that of the diagnosis."""
    negative = name == "diagnosis_no_effect"
    files = {
        "diagnosis": f"{name}.json",
        "comparison": "comparison_no_effect.json" if negative else "comparison.json",
        "next_experiment": "no_experiment.json" if negative else "next_experiment.json",
        "candidates": "candidates.json",
        "settings": "report_settings.json",
    }
    found = {key: DATA / file for key, file in files.items()}
    found |= {"page": TEMPLATES / "diagnosis.html.j2", "style": TEMPLATES / "style.css"}
    return found | others


def confirmations():
    return {revision: DATA / f"confirmation_{revision}.json" for revision in REVISIONS}


def draw(folder, given, confirmed=None):
    """The page's text and the names of its pictures."""
    page, plots = folder / "diagnosis.html", folder / "diagnosis_plots"
    write_diagnosis(given, confirmed or {}, page, plots)
    return page.read_text(), {path.stem for path in plots.glob("*.png")}


def edited(folder, change, file="diagnosis.json"):
    """A copy of an example with `change` applied to its content."""
    content = json.loads((DATA / file).read_text())
    change(content)
    path = folder / file
    path.write_text(json.dumps(content))
    return path


def visible(page):
    """What a reader sees: no scripts, no tags, one blank between words."""
    text = re.sub(r"(?s)<(script|style).*?</\1>", " ", page)
    return " ".join(html.unescape(re.sub(r"<[^>]*>", " ", text)).split())


def section(page, name):
    return visible(re.search(rf'(?s)<section id="{name}">.*?</section>', page)[0])


@pytest.fixture(scope="module")
def full(tmp_path_factory):
    """Everything there is: two effects added, two revisions confirmed."""
    given = inputs(ladder=DATA / "ladder.json")
    return draw(tmp_path_factory.mktemp("full"), given, confirmations())


@pytest.fixture(scope="module")
def negative(tmp_path_factory):
    return draw(tmp_path_factory.mktemp("negative"), inputs("diagnosis_no_effect"))


def test_every_section_and_picture_is_there(full):
    page, plots = full
    sections = re.findall(r'<section id="(\w+)">', page)
    expected = "verdict fails missing unseen unexplained next adding provenance"
    assert sections == expected.split()
    assert plots == {
        "residuals",
        "evidence_gain",
        "confounding",
        "smallest_detectable",
        "unexplained_pattern",
        "ladder",
        "ladder_by_shape",
        "ladder_by_size",
        "confirmation",
    }
    for name in plots:
        assert f'data-chart="{name}"' in page and f'id="chart-{name}"' in page
    assert not re.search(r'(src|href)="https?:', page), "the page must work without a network"


def test_the_verdict_stands_first_in_words(full):
    text = section(full[0], "verdict")
    assert "One of these is missing: friction on the anvil or elastic anvil" in text
    assert "< 0.0001 more than errors" in text and "errors explain it" not in text


def test_numbers_have_names_and_units(full):
    text = section(full[0], "missing")
    assert "Back stress H X 190 MPa 70.4 to 310 +3.1 +2.8" in text
    assert "Dynamic recovery parameters imitate it k 2 – – +0.4 – – – 0.06" in text
    assert "Thermal softening wrong sign" in text
    assert "without any cause, gains +12.5 in ln Z" in text
    shot = "truncated cone 124 8 5 300 4.8"
    assert shot in section(full[0], "next")


def test_adding_says_what_helped_and_what_did_not(full):
    text = section(full[0], "adding")
    assert "fitted shots falls from 1.51 to 0.95 standard errors" in text
    assert "ln Z rises by 71.4: the data ask for this effect." in text
    assert "ln Z changes by −1.1 only: the data do not ask for this effect." in text
    confirmed = json.loads(confirmations()["anvil_friction"].read_text())
    solver = confirmed["misfit"]["calibrate"]["whitened_rms"]
    assert f"the solver's own misfit is {solver:.2f} (network 0.95) on the fitted shots" in text


def test_no_effect_says_how_large_one_would_have_been_seen(negative):
    page, plots = negative
    text = section(page, "verdict")
    assert "No effect supported" in text
    assert "Friction on the anvil 0.0450" in text and "Back stress 290 MPa" in text
    assert (
        "could not have shown thermal softening, dynamic recovery and error of the velocity meter"
        in text
    )
    assert "errors explain it" in text and 'class="warn"' not in page
    assert "in the set" not in section(page, "missing").partition("Score :")[0]
    assert "No shot is proposed" in section(page, "next")


def test_without_an_added_effect_there_is_no_ladder(negative):
    page, plots = negative
    assert 'id="adding"' not in page and "#adding" not in page
    assert not {"ladder", "confirmation"} & plots


def test_synthetic_data_are_labelled_wherever_shown(full, tmp_path, monkeypatch):
    page, _ = full
    assert "<title>Which physics is missing" in page and "(synthetic data)</title>" in page
    assert page.count("ynthetic data") >= 4
    assert "says nothing of a real metal" in section(page, "verdict")
    marks = []
    monkeypatch.setattr("report.page.save_png", lambda chart, folder, mark: marks.append(mark))
    draw(tmp_path, inputs())
    assert marks and set(marks) == {" (synthetic data)"}


def test_measured_data_are_not_called_synthetic(tmp_path, monkeypatch):
    marks = []
    monkeypatch.setattr("report.page.save_png", lambda chart, folder, mark: marks.append(mark))

    def measure(settings):
        settings |= {"synthetic": False, "synthetic_note": ""}

    settings = edited(tmp_path, measure, "report_settings.json")
    page, _ = draw(tmp_path, inputs(settings=settings))
    assert "Synthetic data" not in page and "(synthetic data)" not in page
    assert set(marks) == {""}


def test_text_of_the_files_cannot_become_markup(tmp_path, monkeypatch):
    monkeypatch.setattr("report.page.save_png", lambda chart, folder, mark: None)
    evil = "<img src=x onerror=alert(1)></script>"

    def spoil(diagnosis):
        diagnosis["verdict"]["words"] = evil
        diagnosis["candidates"][0]["name"] = evil
        diagnosis["candidates"][0]["unit"] = evil
        diagnosis["bad_data"][0]["id"] = evil

    def spoil_symbol(candidates):
        candidates["candidates"][1]["symbol"] = evil

    page, _ = draw(
        tmp_path,
        inputs(
            diagnosis=edited(tmp_path, spoil),
            candidates=edited(tmp_path, spoil_symbol, "candidates.json"),
        ),
    )
    assert "onerror=alert(1)&gt;" in page
    assert "onerror=alert(1)></script>" not in page
    outside = re.sub(r"(?s)<script.*?</script>", "", page)
    assert "<img src=x" not in outside


@pytest.mark.parametrize(
    "kind, effects, shots, words",
    [
        ("effect", ["hall_petch"], [], "Missing effect: strengthening by grain refinement"),
        ("effect", ["hall_petch", "c_d"], [], ": strengthening by grain refinement and c d"),
        ("effect", ["a", "b"], [], "Missing effects: a and b"),
        ("one of", ["a", "b", "c_d"], [], "One of these is missing: a, b or c d"),
        ("not distinguishable", [], [], "these data cannot tell what"),
        ("outside the list", [], [], "not in the list of effects"),
        ("bad data", [], ["s7", "s9"], "Bad data: shots s7 and s9"),
    ],
)
def test_each_verdict_has_a_heading(kind, effects, shots, words):
    assert words in verdict.heading({"kind": kind, "effects": effects, "shots": shots})


def test_a_file_of_another_schema_is_refused(tmp_path):
    def age(diagnosis):
        diagnosis["schema"] = "taylorcal/diagnosis/0"

    with pytest.raises(InputError, match="diagnosis.json: schema = 'taylorcal/diagnosis/0'"):
        load_diagnosis(inputs(diagnosis=edited(tmp_path, age)))


def test_a_broken_file_is_named_with_its_line(tmp_path):
    broken = tmp_path / "candidates.json"
    broken.write_text('{"candidates": [\n')
    with pytest.raises(InputError, match=r"candidates.json, line 2: .* \(expected JSON\)"):
        load_diagnosis(inputs(candidates=broken))
