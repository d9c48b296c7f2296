# What the page of a diagnosis shows besides the diagnosis.
from revisions import revision_ids


def ladder_of(wildcards):
    """The study's ladder; none before an effect was added."""
    name, _ = split_home(wildcards.study)
    return f"results/{name}/ladder.json" if study_of(name)["effects"] else []


def confirmations_of(wildcards):
    name, _ = split_home(wildcards.study)
    if not study_of(name)["effects"]:
        return []
    return [f"results/{home}/confirmation.json" for home in homes_of_study(name)]


def revisions_of_page(wildcards):
    """The ids that belong to `confirmations_of`."""
    name, _ = split_home(wildcards.study)
    effects = study_of(name)["effects"]
    return revision_ids(effects) if effects else []
