"""Words what was found of new shots, for the terminal."""

from new_rows.examine import IMPOSSIBLE, STRANGE, Addition, NewShot
from new_rows.model import SizeCheck


def addition_words(addition: Addition) -> str:
    count = len(addition.shots)
    lines = [f"{addition.source}: {count} new row{'s' * (count > 1)} for {addition.table}"]
    if addition.no_model:
        lines.append(f"no prediction beside the sizes: {addition.no_model}")
    else:
        lines.append(f"model: the posterior of {addition.home}; deviations in standard errors")
    for shot in addition.shots:
        lines += ["", *_of_shot(shot)]
    return "\n".join(lines)


def _of_shot(shot: NewShot) -> list[str]:
    place = "inside" if shot.inside else "outside"
    row = shot.row
    lines = [f"{row['id']} (line {row['line']}, {row['use']}): {place} the database's range"]
    lines += [f"  error: {problem}" for problem in shot.wrong]
    lines += [f"  note: {remark}" for remark in shot.remarks]
    if not shot.prediction:
        return lines
    if shot.prediction.stand_in:
        lines.append(
            f"  note: lot {row['lot']!r} is new and has no parameters yet; predicted as the "
            f"nearest known lot, {shot.prediction.stand_in!r}, for orientation only"
        )
    known = [size.size for size in shot.prediction.sizes]
    lines += [_of_size(size) for size in shot.prediction.sizes]
    others = [key for key in row if f"{key}_sd" in row and key not in known]
    if others:
        lines.append(f"  not among the fitted sizes: {', '.join(others)}")
    return lines


def _of_size(size: SizeCheck) -> str:
    text = (
        f"  {size.size:<24}{size.measured:>9.4g}  model {size.predicted:>7.4g} "
        f"+- {size.sd:<7.2g}{size.deviation:>+7.1f}"
    )
    if abs(size.deviation) > IMPOSSIBLE:
        return f"{text}  a slip of the pen?"
    if abs(size.deviation) > STRANGE:
        return f"{text}  far off: look at the number again"
    return text
