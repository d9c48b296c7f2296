"""Which of the measured sizes are scores of outlines, and which scale with the diameter."""

OUTLINE_SCORES = [f"outline_pc_{k}" for k in range(1, 5)]  # of principal components, in mm


def is_radial(size: str) -> bool:
    """Whether a size scales with the diameter, and not with the length."""
    return "diameter" in size or size in OUTLINE_SCORES
