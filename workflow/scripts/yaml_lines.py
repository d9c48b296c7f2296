"""Reads YAML and remembers the line of each key, so that messages can name it."""

from pathlib import Path

import yaml

from input_errors import InputError


def read_yaml(path: Path) -> tuple[dict, dict[tuple, int]]:
    """The content, and the line of each path of keys: {("database", "runs"): 12}."""
    lines: dict[tuple, int] = {}
    try:
        text = path.read_text(encoding="utf-8-sig")
        tree = yaml.compose(text, Loader=yaml.SafeLoader)
        if tree is not None:
            _collect(tree, (), lines, path)
        content = yaml.load(text, Loader=_Loader)
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}).") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: is not text in UTF-8 ({error}). Save it as UTF-8.") from error
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f", line {mark.line + 1}" if mark else ""
        raise InputError(f"{path}{line}: is not YAML: {' '.join(str(error).split())}") from error
    except ValueError as error:  # such as !!int of a word
        raise InputError(f"{path}: is not YAML: {error}") from error
    if not isinstance(content, dict):
        raise InputError(f"{path}: holds no keys (expected `title:`, `parameters:` ...).")
    return content, lines


def placed(path: Path, lines: dict, key: tuple, problem: str) -> str:
    """<file>, line n: <key> <problem>; a missing key gets the line of its group."""
    here = key
    while here and here not in lines:
        here = here[:-1]
    line = f", line {lines[here]}" if here else ""
    return f"{path}{line}: {_name(key)} {problem}"


class _Loader(yaml.SafeLoader):
    """As PyYAML's, but a date stays the text that it is: no study has one, and 2020-02-30 fails."""


_Loader.add_constructor("tag:yaml.org,2002:timestamp", yaml.SafeLoader.construct_yaml_str)


def _collect(
    node: yaml.Node, path: tuple, lines: dict, file: Path, inside: tuple[yaml.Node, ...] = ()
) -> None:
    """Notes the lines of `node`, which stands in the nodes `inside`."""
    if node in inside:
        line = node.start_mark.line + 1
        raise InputError(f"{file}, line {line}: {_name(path)} holds itself. Write it out.")
    inside = (*inside, node)
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            line = key.start_mark.line + 1
            if not isinstance(key, yaml.ScalarNode):
                raise InputError(
                    f"{file}, line {line}: a key is a list or group (expected a word)."
                )
            here = (*path, key.value)
            if here in lines:
                raise InputError(
                    f"{file}, line {line}: {_name(here)} is given twice (first in line "
                    f"{lines[here]})."
                )
            lines[here] = line
            _collect(value, here, lines, file, inside)
    elif isinstance(node, yaml.SequenceNode):
        for index, value in enumerate(node.value):
            lines[(*path, index)] = value.start_mark.line + 1
            _collect(value, (*path, index), lines, file, inside)


def _name(path: tuple) -> str:
    return ".".join(map(str, path))
