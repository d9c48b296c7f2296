"""Digests of code: what counts, and for which program."""

import ast
import re
import shutil
import subprocess

import pytest
from tiny_study import ROOT

import code_digest
from code_digest import SCRIPTS, modules_of, script_digest

PROGRAMS = ["solver", "emulator", "calibrate"]
FOLDERS = ["common", "solver", "emulator", "calibrate", "experiments/equation_of_state"]


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    """A copy of the programs' sources elsewhere, with other dates and without a repository."""
    folder = tmp_path_factory.mktemp("clone") / "taylorcal"
    folder.mkdir()
    shutil.copy(ROOT / "CMakeLists.txt", folder)
    for name in FOLDERS:
        shutil.copytree(ROOT / name, folder / name, copy_function=shutil.copyfile)
    return folder


def digests(sources) -> dict[str, str]:
    found = {}
    for program in PROGRAMS:
        written = sources / f"{program}.cpp.txt"
        options = [f"-DSOURCE={sources}", f"-DPROGRAM={program}", f"-DOUTPUT={written}"]
        script = ["-P", ROOT / "common" / "program_code.cmake"]
        subprocess.run(["cmake", *options, *script], check=True, capture_output=True)
        found[program] = re.search(r'"([0-9a-f]{16})"', written.read_text())[1]
    return found


def test_a_clone_has_the_digests_of_the_checkout(sources, tmp_path):
    assert len(set(digests(sources).values())) == 3
    other = shutil.copytree(sources, tmp_path / "other", copy_function=shutil.copyfile)
    assert digests(other) == digests(sources)


@pytest.mark.parametrize(
    "file, line, changed",
    [
        ("common/random.cpp", "int further;", PROGRAMS),
        ("CMakeLists.txt", "set(further 1)", PROGRAMS),
        ("solver/material/material.hpp", "int further;", ["solver"]),
        ("solver/effects/further.cpp", "int further;", ["solver"]),
        ("emulator/training/adam.cpp", "int further;", ["emulator"]),
        ("emulator/inference/model.hpp", "int further;", PROGRAMS),
        ("experiments/equation_of_state/network.json", " ", ["solver"]),
        ("calibrate/sampling/further.cpp", "int further;", ["calibrate"]),
        ("common/random.cpp", "  // a remark; with [brackets]", []),
        ("common/README.md", "words", []),
        ("emulator/bench_emulator.cpp", "int further;", []),
    ],
)
def test_a_line_more_changes_the_programs_that_it_is_part_of(sources, file, line, changed):
    before, path = digests(sources), sources / file
    text = path.read_text() if path.exists() else None
    path.write_text(f"{text or ''}{line}\n")
    try:
        after = digests(sources)
    finally:
        path.write_text(text) if text is not None else path.unlink()
    assert [name for name in PROGRAMS if after[name] != before[name]] == changed


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_program_tells_its_digest(program, name):
    told = subprocess.run([program(name), "--version"], capture_output=True, text=True).stdout
    assert re.fullmatch(rf"{name} [\d.]+ \(.+\), code [0-9a-f]{{16}}\n", told)


@pytest.fixture
def scripts(tmp_path, monkeypatch):
    """A folder of scripts in place of the workflow's."""
    (tmp_path / "drawing").mkdir()
    (tmp_path / "drawing" / "__init__.py").write_text("")
    (tmp_path / "drawing" / "line.py").write_text("WIDTH = 1\n")
    (tmp_path / "page.py").write_text("from drawing import line\n")
    (tmp_path / "make.py").write_text('"""A script."""\nimport json\n\nimport page\n')
    monkeypatch.setattr(code_digest, "SCRIPTS", tmp_path)
    return tmp_path


def digest_now() -> str:
    for cached in (script_digest, code_digest._tree, code_digest._statements):
        cached.cache_clear()
    return script_digest("make.py")


def test_a_script_counts_with_the_modules_that_it_imports(scripts):
    assert {path.name for path in modules_of("make.py")} == {
        "make.py", "page.py", "line.py", "__init__.py"
    }  # fmt: skip
    before = digest_now()
    (scripts / "drawing" / "line.py").write_text("WIDTH = 2\n")
    assert digest_now() != before


def test_stages_take_from_the_study_only_what_checks_it():
    """Its own digest does not count; settings, which rules take from it, are noted themselves."""
    stages = [path.name for path in SCRIPTS.glob("*.py") if "snakemake.log" in path.read_text()]
    modules = {module for name in stages for module in modules_of(name)}
    taken = {
        (module.name, alias.name)
        for module in modules
        for node in ast.walk(ast.parse(module.read_text()))
        if isinstance(node, ast.ImportFrom) and node.module == "study"
        for alias in node.names
    }
    assert {"make_report.py", "make_outline_basis.py"} < set(stages)
    assert SCRIPTS / "size_kinds.py" in modules_of("make_outline_basis.py")
    assert taken == {("measurements.py", "database_parts")}


def test_words_and_layout_of_a_script_do_not_count(scripts):
    before = digest_now()
    text = '"""Another docstring."""\nimport json  # a remark\nimport page\n'
    (scripts / "make.py").write_text(text)
    assert digest_now() == before
