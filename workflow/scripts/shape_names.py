"""Names of specimens: the paper's four, or a head or cone with measures of its own.

`reduced_head_5mm_by_12mm` has an end 5 mm wide and a head 12 mm long on the paper's specimen of
8 mm x 40 mm; `..._of_7.6mm_by_25.4mm` names another one. All scale with a shot's diameter and
length. The solver reads the same names (common/specimen_names.cpp).
"""

import re

PAPER_SHAPES = ["uniform_cylinder", "reduced_head_4mm", "reduced_head_3mm", "truncated_cone"]
USUAL_DIAMETER, USUAL_LENGTH = 8, 40  # [mm], and the heads' lengths
USUAL_HEADS = {"reduced_head": 10, "truncated_cone": 20}
ENDS, HEADS = (0.15, 0.9), (0.05, 0.8)  # shares of diameter and length that can be computed
BETWEEN_HEADS = 3.5 / USUAL_DIAMETER  # a head is cut as the paper's 4-mm or 3-mm one
MM = r"_(\d+(?:\.\d+)?)mm"
MEASURED = re.compile(rf"(reduced_head|truncated_cone){MM}(?:_by{MM})?(?:_of{MM}_by{MM})?")


def is_shape(name: str) -> bool:
    return name in PAPER_SHAPES or MEASURED.fullmatch(name) is not None


def shape_problem(name: str) -> str:
    """Why the solver has no such shape (its shape_names.cpp), or an empty text."""
    measured = MEASURED.fullmatch(name)
    if name in PAPER_SHAPES or not measured:
        return ""
    end, head, diameter, length = (float(mm) if mm else None for mm in measured.groups()[1:])
    diameter = USUAL_DIAMETER if diameter is None else diameter
    length = USUAL_LENGTH if length is None else length
    if diameter <= 0 or length <= 0:
        return f"a specimen of {diameter:g} mm by {length:g} mm (expected measures above 0)."
    head = USUAL_HEADS[measured[1]] if head is None else head
    parts = [("end's diameter", end, diameter, ENDS), ("head's length", head, length, HEADS)]
    for what, part, whole, (lowest, highest) in parts:
        if not lowest <= part / whole <= highest:
            return (
                f"the {what} is {part:g} mm of the specimen's {whole:g} mm (expected "
                f"{lowest * whole:.4g} to {highest * whole:.4g} mm). Check the name's measures."
            )
    return ""


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
