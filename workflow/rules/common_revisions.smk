# What the rules share about a study's revisions.
def ladder_inputs(file):
    def find(wildcards):
        return [f"results/{home}/{file}" for home in homes_of_study(wildcards.name)]

    return find


def targets_of_study(name):
    """The base's report; with effects added also the last revision's, and the ladder.

    A ladder that is there goes on being kept up, so that it drops an effect with the study.
    """
    homes = homes_of_study(name)
    targets = [f"results/{home}/report.html" for home in dict.fromkeys([homes[0], homes[-1]])]
    ladder = f"results/{name}/ladder.json"
    return targets + ([ladder] if len(homes) > 1 or Path(ladder).exists() else [])
