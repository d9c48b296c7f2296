"""The fields that `solver run --snapshots` writes, opened by VTK's own reader."""

import json
import subprocess

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

VERTEX, QUADRILATERAL = 1, 9  # VTK's numbers of cell types


@pytest.fixture(scope="module", params=["axisymmetric", "3d"])
def snapshots(request, solver, tmp_path_factory):
    """Geometry, folder and answer of 8 us of an impact, kept every 2 us."""
    folder = tmp_path_factory.mktemp("snapshots")
    command = [solver, "run", "--velocity", "100", "--geometry", request.param, "--json"]
    command += ["--numerics", "elements_across_radius=4", "--until-us", "8"]
    command += ["--snapshots", folder / "fields", "--every-us", "2"]
    finished = subprocess.run(command, capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    return request.param, folder / "fields", json.loads(finished.stdout)


def series_of(folder):
    return json.loads((folder / "snapshots.vtkhdf.series").read_text())["files"]


def read(path):
    reader = vtkHDFReader()
    assert reader.CanReadFile(str(path))
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def field(grid, name):
    return vtk_to_numpy(grid.GetCellData().GetArray(name))


def test_the_series_names_every_snapshot_with_its_time(snapshots):
    _, folder, _ = snapshots
    times = [entry["time"] for entry in series_of(folder)]
    assert times == sorted(times)
    assert times == pytest.approx([0, 2, 4, 6, 8], abs=1e-6)
    assert all((folder / entry["name"]).is_file() for entry in series_of(folder))


def test_vtk_reads_cells_or_particles_with_their_fields(snapshots):
    geometry, folder, answer = snapshots
    for entry in series_of(folder):
        grid = read(folder / entry["name"])
        assert grid.GetNumberOfCells() == answer["points"]
        expected = QUADRILATERAL if geometry == "axisymmetric" else VERTEX
        assert {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())} == {expected}
        assert np.isfinite(field(grid, "von_mises_GPa")).all()
        assert field(grid, "volume_mm3").sum() == pytest.approx(np.pi * 16 * 40, rel=0.02)


def test_the_fields_tell_the_impact(snapshots):
    _, folder, answer = snapshots
    first, last = (read(folder / series_of(folder)[i]["name"]) for i in (0, -1))
    assert field(first, "equivalent_plastic_strain").max() < 0.05
    assert field(last, "equivalent_plastic_strain").max() > 0.2
    # The rear has moved on by the way it flies in 8 us, the foot stands on the anvil.
    assert first.GetBounds()[5] - last.GetBounds()[5] == pytest.approx(0.8, rel=0.1)
    assert field(last, "temperature_K").max() == pytest.approx(
        answer["descriptors"]["largest_temperature_K"], rel=0.03
    )
