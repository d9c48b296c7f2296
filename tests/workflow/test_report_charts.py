"""What the charts of the report say, as data: no picture is drawn here."""

import json
from pathlib import Path
from types import SimpleNamespace

import pytest

from report.chart import Points
from report.diagnosis_results import DiagnosisResults
from report.ladder_charts import ladder_chart, shape_chart, size_chart
from report.quality_charts import network_chart
from report.residual_charts import heat_map, lot_heat_map, scatter_chart
from report.words import relative_words

DATA = Path(__file__).parent / "data"


def shot(use="calibrate", **cell):
    specimen = {"lot": "one", "shape": "uniform_cylinder", "velocity_m_s": 150}
    specimen |= {"initial_diameter_mm": 8.0, "initial_length_mm": 40.0, "id": "a1", "use": use}
    known = {"measured": 20.0, "sd": 0.1, "residual": 0.4, "whitened": 1.0}
    return specimen | {"sizes": [known | cell]}


def example(name):
    return json.loads((DATA / f"{name}.json").read_text())


@pytest.fixture
def revisions():
    """Two effects added, two revisions confirmed."""
    return DiagnosisResults(
        settings={},
        comparison=example("comparison"),
        diagnosis={},
        candidates={},
        next_experiments=[],
        ladder=example("ladder")["revisions"],
        confirmations={
            name: example(f"confirmation_{name}") for name in ("base", "anvil_friction")
        },
    )


@pytest.mark.parametrize(
    "size, measured, share",
    [
        ("final_length_mm", 20.0, "+2.0"),
        ("undeformed_length_mm", 0.2, "+1.0"),
        ("outline_pc_1", 0.01, "+5.0"),
    ],
)
def test_deviations_of_a_lot_are_relative_to_what_calibrate_takes(size, measured, share):
    results = SimpleNamespace(comparison={"shots": [shot(size=size, measured=measured)]})
    cells = lot_heat_map(results).panels[0].layers[0]
    assert f"<b>{share}\u202f%</b>" in cells.texts[0][0]


def test_captions_say_what_per_cent_are_of():
    assert relative_words(["final_length_mm"]) == "in per cent of the size"
    assert "the undeformed length's of L0" in relative_words(["undeformed_length_mm"])
    assert "outlines' of the initial diameter" in relative_words(["outline_pc_2"])


def test_more_shapes_than_colours_are_drawn():
    pairs = [
        {"output": "final_length_mm", "shape": f"shape_{k}", "solver": 20 + k, "network": 20}
        for k in range(9)
    ]
    results = SimpleNamespace(emulator={"validation": {"pairs": pairs}})
    points = [layer for layer in network_chart(results).panels[0].layers if layer.legend]
    assert len(points) == 9 and points[8].colour == points[0].colour


def test_thirds_of_velocities_have_their_ranges(revisions):
    several = heat_map(revisions.comparison)
    assert several.title.startswith("Measured − model") and several.title.endswith("in m/s")
    assert several.panels[0].layers[0].columns == ["≤ 63", "63–94", "> 94"]
    of_one = [g for g in revisions.comparison["groups"] if g["key"].startswith("uniform_cyl")]
    (panel,) = heat_map({**revisions.comparison, "groups": of_one}).panels
    assert panel.layers[0].columns[1] == "middle third, 63–94 m/s"
    for chart in (shape_chart(revisions), size_chart(revisions)):
        assert chart.panels[0].x_ticks == ["≤ 63", "63–94", "> 94"]
        assert chart.panels[0].x_label == "velocity, m/s"
    assert size_chart(revisions).panels[0].y_label == "measured − model, %"


def marks(panel):
    return [layer for layer in panel.layers if isinstance(layer, Points)]


def test_every_mark_of_the_ladder_has_a_legend(revisions):
    legends = {
        (points.symbol, points.hollow): points.legend
        for points in marks(ladder_chart(revisions).panels[0])
    }
    assert legends == {
        ("circle", False): "fitted shots",
        ("circle", True): "shots held back",
        ("diamond", False): "fitted shots, by the solver",
        ("diamond", True): "shots held back, by the solver",
    }


def test_marks_held_back_have_one_legend_for_all_colours():
    shots = [shot(use, size="final_length_mm") for use in ("calibrate", "validate")]
    rows = [{"lot": lot, "shape": "uniform_cylinder"} for lot in ("one", "two")]
    given = {"shots": shots + [one | {"lot": "two"} for one in shots]}
    results = SimpleNamespace(comparison=given, lots=["one", "two"], used_rows=rows)
    points = marks(scatter_chart(results).panels[0])
    legends = {(one.legend, one.hollow) for one in points if one.legend}
    assert legends == {("one", False), ("two", False), ("held back", True)}
