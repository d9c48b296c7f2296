"""Reads YAML and remembers the line of each key, so that messages can name it."""

from pathlib import Path

import yaml

from input_errors import InputError


def read_yaml(path: Path) -> tuple[dict, dict[tuple, int]]:
    """The content, and the line of each path of keys: {("database", "runs"): 12}."""
    try:
        text = path.read_text(encoding="utf-8")
        tree = yaml.compose(text, Loader=yaml.SafeLoader)
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}).") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: is not YAML: {' '.join(str(error).split())}") from error
    lines: dict[tuple, int] = {}
    if tree is not None:
        _collect(tree, (), lines, path)
    content = yaml.safe_load(text)
    if not isinstance(content, dict):
        raise InputError(f"{path}: holds no keys (expected `title:`, `parameters:` ...).")
    return content, lines


def _collect(node: yaml.Node, path: tuple, lines: dict, file: Path) -> None:
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            here = (*path, key.value)
            line = key.start_mark.line + 1
            if here in lines:
                name = ".".join(map(str, here))
                raise InputError(
                    f"{file}, line {line}: {name} is given twice (first in line {lines[here]})."
                )
            lines[here] = line
            _collect(value, here, lines, file)
    elif isinstance(node, yaml.SequenceNode):
        for index, value in enumerate(node.value):
            lines[(*path, index)] = value.start_mark.line + 1
            _collect(value, (*path, index), lines, file)
