"""The tutorial of solver/effects/README.md works as it stands."""

import json
import re
import shlex
import shutil
import subprocess

import pytest
from tiny_study import ROOT

README = ROOT / "solver/effects/README.md"
LONGEST = 60  # lines of file, entry and test together


def steps():
    """The tutorial's code blocks: {path of a new file: text}, the patch, the commands."""
    tutorial = README.read_text().split("## Your own effect", 1)[1]
    blocks = re.findall(r"\*\*\d\. [^`]*(?:`([^`]+)`)?:\n```(\w+)\n(.*?)```", tutorial, re.S)
    files = {path: text for path, kind, text in blocks if kind == "cpp"}
    patches = [text for _, kind, text in blocks if kind == "diff"]
    commands = [text for _, kind, text in blocks if kind == "sh"]
    assert len(files) == 2 and len(patches) == 1 and len(commands) == 1
    return files, patches[0], commands[0].splitlines()


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, f"{shlex.join(map(str, command))}\n{done.stdout}{done.stderr}"
    return done.stdout


def compile_like(build, model, source, folder):
    """Compiles `source` as the file `model` of the tree, with the folder's headers first."""
    entries = json.loads((build / "compile_commands.json").read_text())
    command = next(e["command"] for e in entries if e["file"] == str(ROOT / model))
    words = [word for word in shlex.split(command) if not word.endswith("ccache")]
    target = source.with_suffix(".o")
    changes = {"-o": target, "-c": source}
    for i, word in enumerate(words[:-1]):
        if word in changes:
            words[i + 1] = str(changes[word])
    run([words[0], f"-I{folder}", *words[1:]], build)
    return target


def link_like(build, target, objects, without=None):
    """Links a program of the build anew, with other objects before its own."""
    command = run(["ninja", "-t", "commands", target], build).splitlines()[-1]
    words = shlex.split(command.removeprefix(": && ").removesuffix(" && :"))
    out = objects[0].parent / target
    words[words.index("-o") + 1] = str(out)
    own = [w for w in words if w.endswith(".o")]
    first = words.index(own[0])
    words = [w for w in words if not (without and w.endswith(".o") and without in w)]
    run([*words[:first], *map(str, objects), *words[first:]], build)
    return out


def test_the_list_of_effects_is_in_the_readme(program):
    names = {
        effect["name"]
        for effect in json.loads(run([program("solver"), "effects", "--json"], ROOT))["effects"]
    }
    table = README.read_text().split("| effect | amplitude", 1)[1].split("\n\n", 1)[0]
    assert set(re.findall(r"^\| `(\w+)`", table, re.M)) == names


def test_the_tutorial_is_short():
    files, patch, _ = steps()
    added = [line for line in patch.splitlines() if re.match(r"\+[^+]", line)]
    assert sum(len(text.splitlines()) for text in files.values()) + len(added) < LONGEST


def test_following_the_tutorial_gives_a_new_effect(program, build, tmp_path):
    for name in ("solver", "test_effects"):
        program(name)
    if not (build / "build.ninja").exists():
        pytest.skip("the build is not one of ninja")
    files, patch, commands = steps()
    shutil.copytree(ROOT / "solver/effects", tmp_path / "solver/effects")
    shutil.copytree(ROOT / "tests/unit/effects", tmp_path / "tests/unit/effects")
    for path, text in files.items():
        assert not (ROOT / path).exists()
        (tmp_path / path).write_text(text)
    (tmp_path / "entry.diff").write_text(patch)
    run(["git", "apply", "entry.diff"], tmp_path)

    like = "solver/effects/hall_petch.cpp"
    effect_file, test_file = files
    objects = [
        compile_like(build, like, tmp_path / effect_file, tmp_path),
        compile_like(build, like, tmp_path / "solver/effects/effect_list.cpp", tmp_path),
    ]
    test = compile_like(build, "tests/unit/effects/list_test.cpp", tmp_path / test_file, tmp_path)
    made = {
        "test_effects": link_like(build, "test_effects", [test, *objects], "test_effects.dir"),
        "solver": link_like(build, "solver", objects),
    }
    assert commands[0] == "cmake --build build --target " + " ".join(sorted(made))
    answers = []
    for line in commands[1:]:
        words = shlex.split(line)
        words[0] = str(made[words[0].removeprefix("build/bin/")])
        answers.append(run(words, tmp_path))
    assert "All tests passed (1 assertion in 1 test case)" in answers[0]
    assert re.search(r"^mobile_hardening +kappaM +1 +0 \.\. 1 ", answers[1], re.M)
    assert re.search(r"^status +stopped$", answers[2], re.M)
