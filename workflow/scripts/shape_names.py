"""Names of specimens: the paper's four, or a head or cone with measures of its own.

`reduced_head_5mm_by_12mm` has an end 5 mm wide and a head 12 mm long on the paper's specimen of
8 mm x 40 mm; `..._of_7.6mm_by_25.4mm` names another one. All scale with a shot's diameter and
length. The solver reads the same names (common/specimen_names.cpp).
"""

import re

PAPER_SHAPES = ["uniform_cylinder", "reduced_head_4mm", "reduced_head_3mm", "truncated_cone"]
USUAL_DIAMETER = 8  # [mm]
BETWEEN_HEADS = 3.5 / USUAL_DIAMETER  # a head is cut as the paper's 4-mm or 3-mm one
MM = r"_(\d+(?:\.\d+)?)mm"
MEASURED = re.compile(rf"(reduced_head|truncated_cone){MM}(?:_by{MM})?(?:_of{MM}_by{MM})?")


def is_shape(name: str) -> bool:
    return name in PAPER_SHAPES or MEASURED.fullmatch(name) is not None


def in_words(shape: str) -> str:
    """For a reader: "4-mm head", "5-mm head by 12 mm"."""
    measured = MEASURED.fullmatch(shape)
    if not measured:
        return shape.replace("_", " ")
    end, head, *of = measured.groups()[1:]
    text = f"{end}-mm {'head' if measured[1] == 'reduced_head' else 'cone'}"
    text += f" by {head} mm" if head else ""
    return text + (f" of {of[0]} mm by {of[1]} mm" if of[0] else "")


def paper_shape_like(shape: str) -> str:
    """The one of the paper's four whose runs cost about as much."""
    measured = MEASURED.fullmatch(shape)
    if shape in PAPER_SHAPES or not measured:
        return shape
    if measured[1] == "truncated_cone":
        return "truncated_cone"
    share = float(measured[2]) / float(measured[4] or USUAL_DIAMETER)
    return "reduced_head_4mm" if share > BETWEEN_HEADS else "reduced_head_3mm"
