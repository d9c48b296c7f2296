"""A chart as data: panels in a grid, each with layers.

Charts are drawn twice, for the page (plotly) and as PNG (matplotlib), so what they show is
said once here and the two drawing modules only translate. Colours are hex, or the name of
a colour of the page's theme ("ink", "faint").
"""

from dataclasses import dataclass, field

PALETTE = ["#3f7fd0", "#d9772f", "#2f9e73", "#c04f7c", "#8468c9", "#a98a1c", "#3d9fb3", "#95603f"]
ACCENT = PALETTE[0]
# Length/diameter and other ordered numbers: dark to warm, legible on light and dark pages.
ORDERED = ["#5b5bd6", "#3f7fd0", "#2d97b8", "#2f9e73", "#86a832", "#d0a021", "#e0843b", "#d2504a"]


def ordered_colour(position: int, count: int) -> str:
    """The colour at a place in an ordered series, between two of the list if need be."""
    place = position * (len(ORDERED) - 1) / max(count - 1, 1)
    first = min(int(place), len(ORDERED) - 2)
    ends = [
        [int(colour[start : start + 2], 16) for start in (1, 3, 5)]
        for colour in ORDERED[first : first + 2]
    ]
    mixed = [round(a + (b - a) * (place - first)) for a, b in zip(*ends)]
    return "#" + "".join(f"{channel:02x}" for channel in mixed)


@dataclass
class Points:
    x: list
    y: list
    colour: str = ACCENT
    y_error: list | None = None
    labels: list[str] | None = None  # shown when the pointer is over a point
    hollow: bool = False
    symbol: str = "circle"  # or "cross", "star", "diamond"
    size: float = 7
    legend: str = ""
    legend_rank: int = 0
    texts: list[str] | None = None  # written beside the points


@dataclass
class Line:
    x: list
    y: list
    colour: str = ACCENT
    dashed: bool = False
    filled: bool = False
    width: float = 1.6
    legend: str = ""


@dataclass
class Band:
    x: list
    low: list
    high: list
    colour: str = ACCENT
    opacity: float = 0.2


@dataclass
class Intervals:
    """A vertical bar at each x, for a model's range at single points."""

    x: list
    low: list
    high: list
    colour: str = ACCENT


@dataclass
class Spans:
    """A horizontal bar at each height, from `low` to `high`."""

    y: list
    low: list
    high: list
    colour: str = ACCENT
    width: float = 7  # [px]
    opacity: float = 1
    labels: list[str] | None = None  # shown when the pointer is over an end
    legend: str = ""


@dataclass
class Bars:
    names: list[str]
    values: list[float]
    texts: list[str]
    colour: str = ACCENT


@dataclass
class Histogram:
    edges: list
    counts: list
    colour: str = ACCENT


@dataclass
class Map:
    """Density over a plane; cells between edges."""

    x_edges: list
    y_edges: list
    density: list[list[float]]  # [x][y]
    colour: str = ACCENT


@dataclass
class Cells:
    """A table of signed values as coloured cells with a text in each."""

    rows: list[str]
    columns: list[str]
    values: list[list[float | None]]
    texts: list[list[str]]
    limit: float  # the value of the full colour


@dataclass
class Panel:
    layers: list
    title: str = ""
    x_label: str = ""
    y_label: str = ""
    x_log: bool = False
    y_log: bool = False
    x_range: tuple[float, float] | None = None
    y_range: tuple[float, float] | None = None
    y_ticks: list[str] | None = None  # names at y = 0, 1, 2 ...
    x_ticks: list[str] | None = None  # names at x = 0, 1, 2 ...
    hide_y: bool = False


@dataclass
class Chart:
    name: str  # of the PNG
    title: str
    caption: str
    panels: list[Panel] = field(default_factory=list)
    columns: int = 3
    row_height: int = 260  # [px]
    legend: bool = False
    shared_rows: bool = False  # only the first panel of a row says what its rows are

    @property
    def rows(self) -> int:
        return -(-len(self.panels) // self.columns)


def tidy(number: float) -> float | None:
    """Five digits are enough for the eye and keep the page small."""
    return None if number is None or number != number else float(f"{number:.5g}")
