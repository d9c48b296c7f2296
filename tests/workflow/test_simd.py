"""The programs run on any x86-64 since 2009 and take AVX2 and AVX-512 where they are."""

import json
import os
import platform
import re
import subprocess

import h5py
import pytest

VARIANTS = ["v2", "v3", "v4"]
PROGRAMS = ["solver", "emulator", "calibrate"]
# In an instruction of a disassembly: AVX to AVX-512 by prefix or register, and BMI and the like;
# not tzcnt, which older processors run as bsf, with the same answer but for zero.
BEYOND_BASELINE = re.compile(
    r"\t(v(?!err|erw|mcall|mfunc)\w+ |[^%]*%[yz]mm"
    r"|(andn|bextr|bls\w+|bzhi|lzcnt|movbe|mulx|pdep|pext|rorx|sarx|shlx|shrx)\w? )"
)


def run_solver(program, variant, *arguments):
    return subprocess.run(
        [program("solver"), "run", *arguments],
        env={**os.environ, "TAYLORCAL_SIMD": variant},
        capture_output=True,
        text=True,
    )


def sizes(program, variant, *arguments):
    finished = run_solver(program, variant, *arguments, "--json")
    if "expected on this machine" in finished.stderr:
        pytest.skip(f"this machine cannot run {variant}")
    assert finished.returncode == 0, finished.stderr
    return json.loads(finished.stdout)["sizes"]


@pytest.mark.parametrize("variant", VARIANTS[1:])
@pytest.mark.parametrize(
    "arguments",
    [
        ["--velocity=110", "--shape=reduced_head_4mm", "--fidelity=coarse", "--until-us=15"],
        ["--velocity=110", "--set=strength=j2", "--fidelity=coarse", "--until-us=15"],
        [
            "--velocity=110",
            "--geometry=3d",
            "--fidelity=coarse",
            "--numerics=elements_across_radius=3",
            "--until-us=10",
        ],
    ],
    ids=["axisymmetric", "j2", "3d"],
)
def test_the_variants_agree_to_rounding(program, variant, arguments):
    expected = sizes(program, "v2", *arguments)
    assert sizes(program, variant, *arguments) == pytest.approx(expected, rel=1e-5)


def test_an_output_names_its_variant(program, tmp_path):
    out = tmp_path / "run.h5"
    finished = run_solver(program, "v2", "--velocity=110", "--until-us=0.1", f"--out={out}")
    if "expected on this machine" in finished.stderr:
        pytest.skip("this machine has no v2")
    with h5py.File(out) as file:
        assert json.loads(file.attrs["provenance"])["simd"] == "v2"


def test_what_no_machine_runs_is_an_error(program):
    finished = run_solver(program, "v9", "--velocity=110")
    assert finished.returncode == 1
    assert re.fullmatch(
        r'solver: TAYLORCAL_SIMD = "v9" \(expected on this machine: (v2|generic)\b.*\)\. .*\n',
        finished.stderr,
    )


@pytest.mark.skipif(platform.machine() != "x86_64", reason="has no variants")
@pytest.mark.parametrize("name", PROGRAMS)
def test_only_the_variants_hold_what_a_baseline_processor_lacks(program, name):
    """Otherwise the linker could have put AVX into a function that all variants share.

    What a processor of 2009 lacks must be found in on_v3 and on_v4 and nowhere else.
    """
    listing = subprocess.run(
        ["objdump", "--disassemble", "--no-show-raw-insn", program(name)],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    inside = {"on_v3": 0, "on_v4": 0}
    function = ""
    for line in listing.splitlines():
        if line.endswith(">:"):
            function = line
        elif BEYOND_BASELINE.search(line):
            variant = re.search(r"<_ZN9taylorcal4simd5(on_v[34])I", function)
            assert variant, f"{name}: {line} in {function}"
            inside[variant[1]] += 1
    assert all(count > 100 for count in inside.values()), inside
