"""Files that are whole or not there."""

import os

import pytest

from atomic_file import write_text, written_whole
from outlines.table import write_scored_table


def test_a_failure_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "table.md"
    path.write_text("old")
    with pytest.raises(OSError, match="disk full"), written_whole(path) as partial:
        partial.write_text("half")
        raise OSError("disk full")
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["table.md"]


def test_a_link_stays_one_and_a_file_keeps_its_rights(tmp_path):
    path, link = tmp_path / "study.yaml", tmp_path / "link.yaml"
    path.write_text("old")
    path.chmod(0o640)
    link.symlink_to(path)
    write_text(link, "new")
    assert link.is_symlink() and path.read_text() == "new"
    assert path.stat().st_mode & 0o777 == 0o640


def test_a_table_that_cannot_be_made_is_not_begun(tmp_path, monkeypatch):
    table, target = tmp_path / "measurements.csv", tmp_path / "scored.csv"
    table.write_text("id,shape,initial_diameter_mm\na1,uniform_cylinder,8\n")

    def fail(*_):
        raise OSError("disk full")

    monkeypatch.setattr("csv.DictWriter.writerows", fail)
    with pytest.raises(OSError, match="disk full"):
        write_scored_table(table, None, {}, target)
    assert os.listdir(tmp_path) == ["measurements.csv"]
