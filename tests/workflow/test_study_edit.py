"""Effects are added to study.yaml and taken out without touching the rest of its text."""

import pytest
import yaml
from tiny_study import STUDY_YAML

from input_errors import InputError
from study_edit import with_effect, without_effect

LISTS = {
    "flow": "effects: [back_stress] # the first\n",
    "empty": "effects: []  # none\n",
    "no value": "effects:   # none\n",
    "lines": "effects: [\n  back_stress,  # why\n  rod_texture,\n]\n",
    "block": "effects:\n  - back_stress  # why\n  - rod_texture\n",
    "flat block": "effects:\n- back_stress\n# a remark\n",
}


def effects_of(text: str) -> list:
    return yaml.safe_load(text)["effects"] or []


def remarks(text: str) -> list[str]:
    return [line.partition("#")[2] for line in text.splitlines() if "#" in line]


@pytest.mark.parametrize("kind", LISTS)
def test_an_effect_is_appended_and_the_rest_stays(kind):
    text = STUDY_YAML.replace("solver:", f"{LISTS[kind]}solver:")
    before = effects_of(text)
    added = with_effect(text, "anvil_friction")
    assert effects_of(added) == [*before, "anvil_friction"]
    assert remarks(added) == remarks(text)
    lines = [line for line in added.splitlines() if "anvil_friction" not in line]
    assert set(lines) <= set(text.splitlines())
    assert yaml.safe_load(added) == {**yaml.safe_load(text), "effects": effects_of(added)}


@pytest.mark.parametrize("kind", LISTS)
def test_what_was_added_can_be_dropped(kind):
    text = STUDY_YAML.replace("solver:", f"{LISTS[kind]}solver:")
    dropped = without_effect(with_effect(text, "anvil_friction"), "anvil_friction")
    assert effects_of(dropped) == effects_of(text)
    assert dropped.split() == text.split() or not effects_of(text)
    for name in effects_of(text):
        left = without_effect(text, name)
        assert effects_of(left) == [other for other in effects_of(text) if other != name]


def test_a_study_without_a_list_gets_one_above_the_solver():
    added = with_effect(STUDY_YAML, "anvil_friction")
    assert "effects: [anvil_friction]\n\nsolver:\n" in added
    assert added.replace("effects: [anvil_friction]\n\n", "") == STUDY_YAML


def test_only_what_is_there_can_be_dropped():
    text = with_effect(STUDY_YAML, "anvil_friction")
    with pytest.raises(InputError, match=r"'rod_texture' is not among the effects \(anvil_fr"):
        without_effect(text, "rod_texture")
