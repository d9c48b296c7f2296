"""Writes one element of an angular-dependent potential as a potential of embedded atoms.

The file of `pair_style adp` holds what `eam/alloy` holds (embedding energy, electron density and
pair energy of each element) and after it the angular terms u and w of each pair of elements. Where
both are zero for the element with itself, the metal of that element alone has the same energies
and forces without them, several times faster. https://docs.lammps.org/pair_adp.html
"""

from dataclasses import dataclass
from pathlib import Path

from atomic_file import write_text

VALUES_A_LINE = 5


@dataclass
class Element:
    header: list[str]  # atomic number, mass [g/mol], lattice constant [A], lattice
    embedding: list[str]  # F, eV
    density: list[str]
    pair: list[str]  # r phi, eV A
    largest_angular: float  # |u| and |w|, 0 for a potential of embedded atoms


def read_element(path: Path, name: str) -> tuple[list[str], Element]:
    """The grid (5 words) and the element of an adp file; ValueError if it is not there."""
    lines = path.read_text(encoding="utf-8").splitlines()
    names = lines[3].split()[1:]
    if name not in names:
        raise ValueError(f"{path}: no element {name}. It has: {', '.join(names)}.")
    words = iter(" ".join(lines[4:]).split())

    def take(count: int) -> list[str]:
        return [next(words) for _ in range(count)]

    grid = take(5)
    strengths, distances = int(grid[0]), int(grid[2])
    single = {
        other: (take(4), take(strengths), take(distances)) for other in names
    }  # header, F, density
    pairs = [(i, j) for i in range(len(names)) for j in range(i + 1)]
    own = (names.index(name), names.index(name))
    tables = [{pair: take(distances) for pair in pairs}[own] for _ in range(3)]  # r phi, u, w
    largest = max(abs(float(value)) for table in tables[1:] for value in table)
    return grid, Element(*single[name], tables[0], largest)


def write_eam(path: Path, source: Path, name: str) -> None:
    """ValueError if the element's angular terms with itself are not zero."""
    grid, element = read_element(source, name)
    if element.largest_angular > 0:
        raise ValueError(
            f"{source}: the angular terms of {name} with itself reach {element.largest_angular:g}"
            " (expected 0). Use pair_style adp."
        )
    first = source.read_text(encoding="utf-8").splitlines()[0]
    lines = [first, f"{name} of {source.name}, whose angular terms {name}-{name} are all zero", ""]
    lines += [f"1 {name}", " ".join(grid), " ".join(element.header)]
    for table in (element.embedding, element.density, element.pair):
        for start in range(0, len(table), VALUES_A_LINE):
            lines.append(" ".join(table[start : start + VALUES_A_LINE]))
    write_text(path, "\n".join(lines) + "\n")
