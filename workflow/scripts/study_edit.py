"""Adds effects to study.yaml and takes them out, in its text: comments and layout stay."""

import yaml

from input_errors import InputError

BEFORE = ("solver", "database")  # a new list goes above the first of these sections


def with_effect(text: str, name: str) -> str:
    """The text with `name` as the last of its effects."""
    node = _effects_node(text)
    if node is None:
        return _with_new_list(text, name)
    if not isinstance(node, yaml.SequenceNode):  # `effects:` without a value
        end = node.end_mark.index
        return f"{text[:end]}{'' if text[end - 1] == ' ' else ' '}[{name}]{text[end:]}"
    if node.flow_style:
        if not node.value:
            return f"{text[: node.start_mark.index]}[{name}]{text[node.end_mark.index :]}"
        end = node.value[-1].end_mark.index
        return f"{text[:end]}, {name}{text[end:]}"
    last = node.value[-1]
    line = _line_start(text, last.start_mark.index)
    indent = text[line : text.index("-", line)]
    end = _line_end(text, last.end_mark.index)
    gap = "" if text[end - 1] == "\n" else "\n"
    return f"{text[:end]}{gap}{indent}- {name}\n{text[end:]}"


def without_effect(text: str, name: str) -> str:
    """The text without `name` among its effects; InputError if it is not there."""
    node = _effects_node(text)
    items = node.value if isinstance(node, yaml.SequenceNode) else []
    names = [item.value for item in items]
    if name not in names:
        raise InputError(f"{name!r} is not among the effects ({', '.join(names) or 'none'}).")
    place = names.index(name)
    if len(names) == 1:
        if node.flow_style:
            return f"{text[: node.start_mark.index]}[]{text[node.end_mark.index :]}"
        key = text.rindex(":", 0, node.start_mark.index) + 1
        end = _line_end(text, items[0].end_mark.index)
        return f"{text[:key]} []\n{text[end:]}"
    if not node.flow_style:
        start = _line_start(text, items[place].start_mark.index)
        return text[:start] + text[_line_end(text, items[place].end_mark.index) :]
    if place == 0:
        start, end = items[0].start_mark.index, items[1].start_mark.index
    else:
        start, end = items[place - 1].end_mark.index, items[place].end_mark.index
    return text[:start] + text[end:]


def _effects_node(text: str) -> yaml.Node | None:
    for key, value in yaml.compose(text, Loader=yaml.SafeLoader).value:
        if key.value == "effects":
            return value
    return None


def _with_new_list(text: str, name: str) -> str:
    keys = {key.value: key for key, _ in yaml.compose(text, Loader=yaml.SafeLoader).value}
    section = next(keys[key] for key in BEFORE if key in keys)
    start = section.start_mark.index
    return f"{text[:start]}effects: [{name}]\n\n{text[start:]}"


def _line_start(text: str, index: int) -> int:
    return text.rfind("\n", 0, index) + 1


def _line_end(text: str, index: int) -> int:
    """The place after the end of the line."""
    end = text.find("\n", index)
    return len(text) if end < 0 else end + 1
