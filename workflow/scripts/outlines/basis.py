"""Principal components of the outlines that a database holds, shape by shape.

An outline is the radius over the initial radius of the rear, at fractions of the final
length. Heights weigh by the length that they stand for, so that a score is a root mean
square over the height, wherever the heights lie. Dots of a measured outline lie about
evenly and err alike, so errors of scores in this norm hardly depend on each other.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from input_errors import InputError
from json_file import read_json, write_json
from size_kinds import OUTLINE_SCORES

COMPONENTS = len(OUTLINE_SCORES)
SCHEMA = "taylorcal/outline_basis/1"
FEWEST_RUNS = 2 * COMPONENTS
PLACES = [(0.12, "near the foot"), (0.4, "in the lower part"), (0.7, "in the middle")]
PLACES += [(1.0, "towards the rear")]
NOTABLE = 0.35  # of the largest value: the opposite side of a component that words mention


@dataclass
class ShapeBasis:
    """Of one shape; radii over the initial radius of the rear.

    mean [heights]; components [COMPONENTS x heights], orthonormal in the weights; spread
    [COMPONENTS], standard deviations of the scores over the runs; share, of the variance
    that each explains; truncation [heights x heights], covariance of what is left.
    """

    mean: np.ndarray
    components: np.ndarray
    spread: np.ndarray
    share: np.ndarray
    truncation: np.ndarray
    words: list[str]
    runs: int


@dataclass
class OutlineBasis:
    fractions: np.ndarray  # heights over the final length, rising within (0, 1)
    shapes: dict[str, ShapeBasis]

    def scores(self, shape: str, outlines: np.ndarray) -> np.ndarray:
        """Scores [runs x COMPONENTS] of outlines [runs x heights], over the initial radius."""
        basis = self.shapes[shape]
        return (outlines - basis.mean) * weights_of(self.fractions) @ basis.components.T

    def outline(self, shape: str, scores: np.ndarray, fractions: np.ndarray) -> np.ndarray:
        """The outline that scores [COMPONENTS] stand for, at `fractions` of the length."""
        basis = self.shapes[shape]
        radii = basis.mean + scores @ basis.components
        return np.interp(fractions, self.fractions, radii)


def weights_of(fractions: np.ndarray) -> np.ndarray:
    """The share of the length that each height stands for; sums to 1."""
    between = (fractions[1:] + fractions[:-1]) / 2
    return np.diff(np.concatenate([[0.0], between, [1.0]]))


def make_basis(fractions: np.ndarray, outlines: dict[str, np.ndarray]) -> OutlineBasis:
    """`outlines` of each shape [runs x heights], of runs that stopped."""
    root = np.sqrt(weights_of(fractions))
    shapes = {}
    for shape, radii in outlines.items():
        if len(radii) < FEWEST_RUNS:
            raise InputError(
                f"{len(radii)} outlines of {shape} are too few for {COMPONENTS} components "
                f"(expected {FEWEST_RUNS} or more). Raise database.runs."
            )
        mean = radii.mean(axis=0)
        _, sizes, directions = np.linalg.svd((radii - mean) * root, full_matrices=False)
        components = _widening(directions[:COMPONENTS] / root)
        variance = sizes**2 / (len(radii) - 1)
        scores = (radii - mean) * root**2 @ components.T
        left = radii - mean - scores @ components
        shapes[shape] = ShapeBasis(
            mean=mean,
            components=components,
            spread=np.sqrt(variance[:COMPONENTS]),
            share=variance[:COMPONENTS] / variance.sum(),
            truncation=left.T @ left / (len(radii) - 1),
            words=[component_words(fractions, component) for component in components],
            runs=len(radii),
        )
    return OutlineBasis(fractions, shapes)


def _widening(components: np.ndarray) -> np.ndarray:
    """Each with the sign that makes the outline wider where it changes most."""
    places = np.argmax(np.abs(components), axis=1)
    return components * np.sign(components[np.arange(len(components)), places])[:, None]


def component_words(fractions: np.ndarray, component: np.ndarray) -> str:
    """What a positive score does: "wider near the foot, narrower in the middle"."""
    text = f"wider {_place(fractions[np.argmax(component)])}"
    lowest = np.argmin(component)
    if -component[lowest] > NOTABLE * component.max():
        text += f", narrower {_place(fractions[lowest])}"
    return text


def _place(fraction: float) -> str:
    return next(words for end, words in PLACES if fraction <= end)


def write_basis(path: Path, basis: OutlineBasis, provenance: dict) -> None:
    shapes = {
        shape: {
            key: value.tolist() if isinstance(value, np.ndarray) else value
            for key, value in vars(of_shape).items()
        }
        for shape, of_shape in basis.shapes.items()
    }
    document = {"schema": SCHEMA, "fractions": basis.fractions.tolist(), "shapes": shapes}
    document |= {"provenance": provenance}
    write_json(path, document)


def read_basis(path: Path) -> OutlineBasis:
    document = read_json(path, SCHEMA)
    shapes = {
        shape: ShapeBasis(
            **{
                key: value if key in ("words", "runs") else np.array(value)
                for key, value in stored.items()
            }
        )
        for shape, stored in document["shapes"].items()
    }
    return OutlineBasis(np.array(document["fractions"]), shapes)
