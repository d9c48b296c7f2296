"""Numbers and names as the report writes them."""

import json

import pytest

from report import words
from report.chart import Chart, Line, Panel, Points, ordered_colour
from report.plotly_chart import plotly_json


@pytest.mark.parametrize(
    "value, text",
    [
        (2.8213, "2.82"),
        (-0.04567, "−0.0457"),
        (6.3e12, "6.3\u202f×\u202f10<sup>12</sup>"),
        (0, "0"),
        (123456.0, "123456"),
        (float("nan"), "–"),
    ],
)
def test_numbers_have_three_digits(value, text):
    assert words.number(value) == text


def test_names_of_lots_and_parameters():
    assert words.split_name("rho_immobile_initial[jones_soft]") == (
        "rho_immobile_initial",
        "jones_soft",
    )
    name = "rho_immobile_initial[jones_soft]"
    assert words.parameter_words(name) == "initial immobilized density, jones soft"
    assert words.listed(["a", "b", "c"]) == "a, b and c"
    assert words.signed_percent(-0.0123) == "−1.2\u202f%"


@pytest.mark.parametrize(
    "name, text",
    [
        ("muA", "μ<sub>A</sub>"),
        ("rhoI(0)", "ρ<sub>I</sub>(0)"),
        ("k2", "k<sub>2</sub>"),
        ("beta", "β"),
        ("dB/dT", "dB/dT"),
        ("<b>", "&lt;b&gt;"),
    ],
)
def test_symbols_are_set_as_a_paper_does(name, text):
    assert words.symbol(name) == text


def test_signs_and_probabilities():
    assert words.signed(-0.04) == "+0.0"
    assert words.signed(None) == "–"
    assert words.probability(3e-9) == "< 0.0001"
    assert words.probability(0.0421) == "0.042"


def test_missing_values_become_null_in_a_chart():
    panel = Panel([Points([1.0, 2.0], [float("nan"), 3.123456789]), Line([0, 1], [0, 1])])
    figure = json.loads(plotly_json(Chart("name", "title", "", [panel])))
    assert figure["data"][0]["y"] == [None, 3.1235]


def test_ordered_colours_all_differ():
    assert len({ordered_colour(place, 9) for place in range(9)}) == 9
