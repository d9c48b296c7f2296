"""The solver's command line: what it writes, what it refuses, and how a killed batch resumes."""

import json
import re
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest

SIZES = [
    "final_length_mm",
    "impact_diameter_mm",
    "head_length_mm",
    "rear_length_mm",
    "transition_diameter_mm",
    "undeformed_length_mm",
    "diameter_at_0p2L0_mm",
]
INPUTS = [
    "velocity_m_s",
    "initial_diameter_mm",
    "length_to_diameter",
    "initial_temperature_K",
    "hardening_coefficient",
]
# Short bars of a J2 metal: the quickest runs that go the whole way.
QUICK = {
    "geometry": "axisymmetric",
    "fidelity": "coarse",
    "material": {"strength": "j2", "equation_of_state": "linear"},
}


@pytest.fixture
def solver(program, tmp_path):
    """Runs the solver in an empty folder; returns the finished process."""

    def run(*arguments):
        return subprocess.run(
            [program("solver"), *map(str, arguments)],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=300,
        )

    return run


def write_design(path, velocities, names=INPUTS, shape="uniform_cylinder", **changes):
    columns = {
        "velocity_m_s": velocities,
        "initial_diameter_mm": 6.0,
        "length_to_diameter": 1.0,
        "initial_temperature_K": 300.0,
    }
    columns.update(changes)
    rows = len(velocities)
    inputs = np.column_stack([np.broadcast_to(columns.get(name, 2.8), rows) for name in names])
    with h5py.File(path, "w") as file:
        file.attrs["schema"] = "taylorcal/design/1"
        file["run_id"] = np.arange(rows)[::-1].copy()
        file["seed"] = np.arange(rows) + 11
        file.create_dataset("shape", data=[shape] * rows, dtype=h5py.string_dtype())
        dataset = file.create_dataset("inputs", data=inputs)
        dataset.attrs.create("names", names, dtype=h5py.string_dtype())
    return path


@pytest.fixture
def quick(tmp_path):
    (tmp_path / "solver.json").write_text(json.dumps(QUICK))
    return tmp_path


def test_run_prints_and_writes_the_same_sizes(solver, quick):
    done = solver("run", "solver.json", "--velocity", 80, "--diameter-mm", 6, "--length-mm", 12,
                  "--out", "run.h5", "--json")  # fmt: skip
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)
    assert list(answer["sizes"]) == sorted(SIZES)
    assert answer["status"] == "stopped"
    with h5py.File(quick / "run.h5") as file:
        assert file.attrs["schema"] == "taylorcal/run/1"
        assert list(file["sizes"].attrs["names"]) == SIZES
        for name, value in zip(SIZES, file["sizes"]):
            assert answer["sizes"][name] == value
        points = len(file["fields/initial_z_mm"])
        assert points == answer["points"]
        assert all(len(field) == points for field in file["fields"].values())
        assert 0 < file["fields/initial_z_mm"][:].min() < file["fields/initial_z_mm"][:].max() < 12
        history = dict(zip(file["history"].attrs["names"], file["history"][:].T))
        assert history["length_mm"][0] == pytest.approx(12, rel=1e-3)
        assert np.all(np.diff(history["time_us"]) > 0)
        energy = history["total_energy_J"]
        mass = 8930 * np.pi / 4 * 6e-3**2 * 12e-3
        assert history["kinetic_energy_J"][0] == pytest.approx(mass * 80**2 / 2, rel=1e-2)
        assert np.ptp(energy) < 0.01 * history["kinetic_energy_J"][0]
        provenance = json.loads(file.attrs["provenance"])
        assert provenance["configuration"]["configuration"] == QUICK
        outline = file["outline"][:]
        assert outline[:, 0].max() == pytest.approx(answer["sizes"]["final_length_mm"], rel=1e-3)


def test_table_shows_every_size(solver, quick):
    done = solver("run", "solver.json", "--velocity", 40, "--length-mm", 8, "--until-us", 2)
    assert done.returncode == 0, done.stderr
    for name in SIZES + ["stop_time_us", "largest_temperature_K", "energy_error", "cpu_s"]:
        assert re.search(rf"^{name} +[-\d.naife+]+$", done.stdout, re.M), name


def test_a_rear_that_still_moves_has_no_stop_time(solver, quick):
    arguments = ["solver.json", "--velocity", 40, "--length-mm", 8, "--until-us", 1, "--json"]
    done = solver("run", *arguments)
    assert done.returncode == 0, done.stderr
    descriptors = json.loads(done.stdout)["descriptors"]
    assert descriptors["stop_time_us"] is None and descriptors["mean_von_mises_GPa"] is None


def test_a_run_that_loses_its_energy_balance_has_failed(solver, quick):
    """Artificial viscosity far beyond what the time step allows for."""
    arguments = ["--velocity", 150, "--fidelity", "coarse", "--until-us", 10]
    done = solver("run", *arguments, "--numerics", "linear_viscosity=1.5")
    assert done.returncode == 2
    assert re.search(r"the energy balance is off by [0-9.]+ % \(at most 2 %\)", done.stderr)


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["--shape", "cylindr"], ["cylindr", "uniform_cylinder"]),
        (["--shape", "reduced_head_9mm"], ["reduced_head_9mm", "0.15 to 0.9"]),
        (["--set", "hardening_coeficient=2"], ["hardening_coeficient", '"hardening_coefficient"']),
        (["--set", "hardening_coefficient=12"], ["12", "0 to 10"]),
        (["--set", "hardening_coefficient"], ["name=value"]),
        (["--set", "strength=j3"], ["j3", '"j2"']),
        (["--numerics", "hourglas=0.1"], ["numerics.hourglas", '"hourglass"']),
        (["--numerics", "elements_across_radius=0"], ["elements_across_radius = 0", "1 to 200"]),
        (["--numerics", "grains_per_point=5"], ["grains_per_point = 5", "16"]),
        (["--snapshots", "fields", "--every-us", "0"], ["--every-us 0", "0.01 or more"]),
        (["--velocity", "-5"], ["velocity_m_s = -5", "1 to 1000"]),
        (["--diameter-mm", "-8"], ["initial_diameter_mm = -8"]),
        (["--length-mm", "0"], ["initial_length_mm = 0"]),
        (["--geometry", "2d"], ["2d", "3d"]),
        (["--fidelity", "finest"], ["finest", "fine"]),
        (["--diameter-cm", "1"], ["--diameter-cm"]),
        (["nothing.json"], ["nothing.json", "No such file"]),
        (["--seed", "-1"], ["--seed: -1", "0 to 9223372036854775807"]),
        (["--seed", "99999999999999999999"], ["--seed: 99999999999999999999"]),
        (["--out", ""], ["--out: is empty"]),
        (["--geometry", ""], ["--geometry: is empty"]),
        (["--temperature-K", "20"], ["initial_temperature_K = 20", "50 to 1300"]),
    ],
)
def test_run_refuses_with_the_place_and_the_remedy(solver, arguments, words):
    velocity = [] if "--velocity" in arguments else ["--velocity", 100]
    done = solver("run", *velocity, *arguments)
    assert done.returncode == 1
    assert done.stdout == ""
    for word in words:
        assert word in done.stderr


@pytest.mark.parametrize(
    "text, words",
    [
        ('{"fidelty": "coarse"}', ["fidelty", '"fidelity"']),
        ('{"material": {"bulk_moduls": 1e11}}', ["bulk_moduls", '"bulk_modulus"']),
        ('{"material": {"bulk_modulus": 1e15}}', ["bulk_modulus", "1e+12"]),
        ('{"material": {"bulk_modulus": "stiff"}}', ["bulk_modulus", "number"]),
        ('{"material": 3}', ["material"]),
        ('{"fidelity": "coarse",}', ["line 1"]),
    ],
)
def test_configuration_is_read_strictly(solver, tmp_path, text, words):
    (tmp_path / "solver.json").write_text(text)
    done = solver("run", "solver.json", "--velocity", 100)
    assert done.returncode == 1
    for word in ["solver.json", *words]:
        assert word in done.stderr


def test_batch_gives_the_same_bytes_for_one_and_two_threads(solver, quick):
    write_design(quick / "design.h5", np.linspace(40, 90, 5))
    for threads in (1, 2):
        done = solver("batch", "design.h5", "--config", "solver.json", "--threads", threads,
                      "--out", f"database_{threads}.h5")  # fmt: skip
        assert done.returncode == 0, done.stderr
        assert "5/5" in done.stderr
    one = (quick / "database_1.h5").read_bytes()
    assert one == (quick / "database_2.h5").read_bytes()
    with h5py.File(quick / "database_1.h5") as file:
        assert list(file["run_id"]) == [0, 1, 2, 3, 4]
        assert list(file["outputs"].attrs["names"]) == SIZES
        assert list(file["status"]) == [0] * 5
        assert np.all(np.diff(file["inputs"][:, 0]) < 0)  # run_id counts the rows backwards
        assert np.all(np.diff(file["outputs"][:, 0]) > 0)  # slower shots stay longer
    cost = (quick / "database_1.h5.cost.csv").read_text().splitlines()
    assert cost[0] == "run_id,cpu_s" and len(cost) == 6


def test_a_run_of_a_batch_is_the_run_alone(solver, quick):
    write_design(quick / "design.h5", [55.0, 70.0])
    done = solver("batch", "design.h5", "--config", "solver.json", "--out", "database.h5")
    assert done.returncode == 0, done.stderr
    alone = solver("run", "solver.json", "--velocity", 70, "--diameter-mm", 6, "--length-mm", 6,
                   "--seed", 12, "--set", "hardening_coefficient=2.8", "--json")  # fmt: skip
    sizes = json.loads(alone.stdout)["sizes"]
    with h5py.File(quick / "database.h5") as file:
        np.testing.assert_array_equal(file["outputs"][0], [sizes[name] for name in SIZES])


def test_killed_batch_resumes_to_the_same_bytes(solver, program, quick):
    write_design(quick / "design.h5", np.linspace(40, 90, 12))
    command = ["batch", "design.h5", "--config", "solver.json", "--threads", "2", "--out"]
    assert solver(*command, "whole.h5").returncode == 0

    journal = quick / "killed.h5.journal.jsonl"
    process = subprocess.Popen(
        [program("solver"), *command, "killed.h5"], cwd=quick, stderr=subprocess.DEVNULL
    )
    deadline = time.monotonic() + 120
    while not (journal.exists() and journal.read_bytes().count(b"\n") >= 3):
        assert time.monotonic() < deadline and process.poll() is None
        time.sleep(0.005)
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert not (quick / "killed.h5").exists()
    kept = journal.read_bytes().count(b"\n") - 1
    with journal.open("ab") as file:
        file.write(b'{"run_id": 3, "outp')  # as a kill in the middle of a write leaves it

    done = solver(*command, "killed.h5")
    assert done.returncode == 0, done.stderr
    assert f"{kept} of 12 runs are in the journal" in done.stderr
    assert f"{12 - kept}/{12 - kept}" in done.stderr
    assert (quick / "killed.h5").read_bytes() == (quick / "whole.h5").read_bytes()
    assert not journal.exists()


def test_journal_of_another_configuration_is_refused(solver, quick):
    write_design(quick / "design.h5", [60.0])
    (quick / "database.h5.journal.jsonl").write_text(
        '{"schema": "taylorcal/journal/2", "configuration_digest": "0"}\n'
    )
    done = solver("batch", "design.h5", "--config", "solver.json", "--out", "database.h5")
    assert done.returncode == 1
    assert "configuration_digest" in done.stderr and "Delete it" in done.stderr


def test_failed_run_is_a_row(solver, quick):
    """A bar so soft and fast that no mesh survives it, between two that do."""
    soft = QUICK | {"material": QUICK["material"] | {"j2_hardening_modulus": 0}}
    (quick / "solver.json").write_text(json.dumps(soft))
    names = INPUTS[:-1] + ["j2_yield_stress"]
    write_design(quick / "design.h5", [50.0, 1000.0, 60.0], names,
                 j2_yield_stress=[4e8, 1e6, 4e8])  # fmt: skip
    done = solver("batch", "design.h5", "--config", "solver.json", "--out", "database.h5")
    assert done.returncode == 0, done.stderr
    with h5py.File(quick / "database.h5") as file:
        assert file["status"][0] == file["status"][2] == 0
        assert file["status"][1] in (1, 2)
        assert file["reason"][1] != b"" and file["reason"][0] == b""
        assert np.isfinite(file["outputs"][0]).all()


@pytest.mark.parametrize(
    "changes, words",
    [
        ({"names": [*INPUTS[:-1], "hardning_coefficient"]}, ['"hardening_coefficient"']),
        ({"names": INPUTS[:-2]}, ["initial_temperature_K", "missing"]),
        ({"shape": "cilinder"}, ["cilinder", "run 1"]),
        ({"initial_diameter_mm": -6}, ["initial_diameter_mm = -6", "run 1"]),
        ({"hardening_coefficient": 11}, ["hardening_coefficient = 11", "0 to 10"]),
        ({"velocities": []}, ["no row"]),
    ],
)
def test_design_is_validated(solver, quick, changes, words):
    write_design(quick / "design.h5", **{"velocities": [60.0, 70.0], **changes})
    done = solver("batch", "design.h5", "--config", "solver.json", "--out", "database.h5")
    assert done.returncode == 1
    for word in ["design.h5", *words]:
        assert word in done.stderr
    assert sorted(path.name for path in quick.iterdir()) == ["design.h5", "solver.json"]


def test_batch_does_not_replace_its_own_design(solver, quick):
    path = write_design(quick / "design.h5", [60.0])
    before = path.read_bytes()
    done = solver("batch", "design.h5", "--config", "solver.json", "--out", "./design.h5")
    assert done.returncode == 1
    assert "./design.h5: is an input of this command" in done.stderr
    assert path.read_bytes() == before


def test_an_output_without_a_place_is_told_before_the_computation(solver, quick):
    """The inputs are wrong as well, and would be told of first."""
    (quick / "folder").mkdir()
    write_design(quick / "design.h5", [60.0])
    for command in (["run", "--velocity", -5], ["point", "no.json"], ["plate", "no.json"],
                    ["batch", "no.h5"], ["merge", "no.h5"]):  # fmt: skip
        for out, words in [("absent/out", "no folder absent"), ("folder", "it is a folder")]:
            done = solver(*command, "--out", out)
            assert done.returncode == 1
            assert f"{out}: cannot be written" in done.stderr and words in done.stderr


@pytest.mark.parametrize("command", [["parameters"], ["effects", "--json"], ["--help"]])
def test_results_that_cannot_be_printed_are_an_error(program, command):
    for target in (">/dev/full", ">&-"):
        shell = ["sh", "-c", f'"$@" {target}', "sh", program("solver"), *command]
        done = subprocess.run(shell, capture_output=True, text=True, timeout=60)
        assert done.returncode == 2
        assert "standard output: not all of the results could be written" in done.stderr


@pytest.mark.parametrize("threads", ["-1", "1025", "100000", "9999999999999999999999", "two"])
def test_threads_have_bounds(solver, threads):
    done = solver("batch", "design.h5", "--out", "out.h5", "--threads", threads)
    assert done.returncode == 1
    assert f"--threads: {threads} (expected a whole number from 0 to 1024" in done.stderr


def test_truncated_design_is_refused(solver, quick):
    path = write_design(quick / "design.h5", np.linspace(40, 90, 50))
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    done = solver("batch", "design.h5", "--out", "database.h5")
    assert done.returncode == 1
    assert "design.h5" in done.stderr and "truncated" in done.stderr
    done = solver("batch", "missing.h5", "--out", "database.h5")
    assert done.returncode == 1
    assert "missing.h5: no such file" in done.stderr


def test_chunks_merge_to_the_whole(solver, quick):
    write_design(quick / "design.h5", np.linspace(40, 90, 4))
    batch = ["batch", "design.h5", "--config", "solver.json", "--out"]
    assert solver(*batch, "whole.h5").returncode == 0
    assert solver(*batch, "b.h5", "--rows", "0:2").returncode == 0
    assert solver(*batch, "a.h5", "--rows", "2:4").returncode == 0
    assert solver("merge", "b.h5", "a.h5", "--out", "merged.h5").returncode == 0
    assert (quick / "merged.h5").read_bytes() == (quick / "whole.h5").read_bytes()
    assert (quick / "merged.h5.cost.csv").read_text().count("\n") == 5
    done = solver("merge", "a.h5", "a.h5", "--out", "twice.h5")
    assert done.returncode == 1 and "Give each chunk its own rows" in done.stderr
    done = solver("merge", "b.h5", "a.h5", "--zero-input", "foo", "--out", "zero.h5")
    assert done.returncode == 1 and '--zero-input: input "foo" is unknown' in done.stderr
    done = solver(*batch, "c.h5", "--rows", "2:9")
    assert done.returncode == 1 and "0:4" in done.stderr


def test_parameters_lists_names_for_people_and_machines(solver):
    listed = json.loads(solver("parameters", "--json").stdout)
    parameters = {entry["name"]: entry for entry in listed["parameters"]}
    assert parameters["rho_immobile_initial"]["lowest"] == 1e10
    assert parameters["rho_immobile_initial"]["calibrated"]
    assert parameters["poisson_ratio"]["default"] == 0.34
    table = solver("parameters").stdout
    for name, entry in parameters.items():
        line = next(line for line in table.splitlines() if line.startswith(name + " "))
        assert entry["symbol"] in line and entry["source"] in line


@pytest.mark.parametrize("command", ["run", "batch", "merge", "point", "parameters"])
def test_help_ends_with_sample_runs(solver, command):
    done = solver(command, "--help")
    assert done.returncode == 0
    assert f"solver {command}" in done.stdout.split("\n\n")[-1]


def test_wrong_use_exits_with_one(solver):
    assert solver().returncode == 1
    done = solver("fly")
    assert done.returncode == 1
    assert done.stderr.startswith('solver: "fly" is no subcommand')
    assert solver("run").returncode == 1
    assert solver("--version").stdout.startswith("solver 0.")
