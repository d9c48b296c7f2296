"""Names of a study's revisions and of the folders that hold their results.

The base lies in results/<study>; an effect added makes a revision in
results/<study>/revisions/<id>, where the id joins the effects by "+". A folder below
results/ is called a home: "copper" or "copper/revisions/anvil_friction".
"""

BASE = "base"
HOME = r"[A-Za-z0-9_]+(/revisions/[a-z0-9_+]+)?"


def revision_ids(effects: list[str]) -> list[str]:
    """The base and every prefix of the list, in the order of adding."""
    return [revision_id(effects[:count]) for count in range(len(effects) + 1)]


def revision_id(effects: list[str]) -> str:
    return "+".join(effects) or BASE


def home_of(study: str, effects: list[str]) -> str:
    return f"{study}/revisions/{revision_id(effects)}" if effects else study


def homes_of(study: str, effects: list[str]) -> list[str]:
    """The homes of all revisions, the base first."""
    return [home_of(study, effects[:count]) for count in range(len(effects) + 1)]


def split_home(home: str) -> tuple[str, list[str]]:
    """The study's name and the effects that are in."""
    study, _, identity = home.partition("/revisions/")
    return study, identity.split("+") if identity else []


def previous_home(home: str) -> str | None:
    """The home of the revision that this one was added to; None for the base."""
    study, effects = split_home(home)
    return home_of(study, effects[:-1]) if effects else None
