"""The tiny study with a measured outline of its first shot."""

from pathlib import Path

from tiny_study import STUDY_YAML, TABLE, write_study

from size_kinds import OUTLINE_SCORES

OUTLINE = "height_mm,radius_mm\n0,5.9\n1,5.0\n2,4.8\n4,4.5\n6,4.2\n8,4.0\n10,3.9\n12.3,3.8\n"
WITH_OUTLINES = TABLE.replace("source,note", "source,note,outline").replace("1995,\n", "1995,,\n")
WITH_OUTLINES = WITH_OUTLINES.replace('"J, C",\n', '"J, C",,\n')
WITH_OUTLINES = WITH_OUTLINES.replace("House 1995,,\n", "House 1995,,a1.csv\n", 1)
SCORES_TEXT = ", ".join(["final_length_mm", "impact_diameter_mm", *OUTLINE_SCORES])
WITH_SCORES = STUDY_YAML.replace("final_length_mm, impact_diameter_mm", SCORES_TEXT)


def outlined_study(folder: Path, outline: str | None = OUTLINE) -> Path:
    write_study(folder, WITH_SCORES, WITH_OUTLINES)
    if outline is not None:
        (folder / "a1.csv").write_text(outline)
    return folder
