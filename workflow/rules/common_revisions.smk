# What the rules share about a study's revisions.
# What a user reads: deleting one of them makes it again, with what follows from it.
RESULTS = ["database.h5", "emulator.json", "posterior.h5", "comparison.json", "report.html", "plots"]


def ladder_inputs(file):
    def find(wildcards):
        return [f"results/{home}/{file}" for home in homes_of_study(wildcards.name)]

    return find


def targets_of_study(name):
    """The base's results; with effects added also the last revision's, and the ladder.

    A ladder that is there goes on being kept up, so that it drops an effect with the study.
    """
    homes = homes_of_study(name)
    homes_read = dict.fromkeys([homes[0], homes[-1]])
    targets = [f"results/{home}/{file}" for home in homes_read for file in RESULTS]
    ladder = f"results/{name}/ladder.json"
    return targets + ([ladder] if len(homes) > 1 or Path(ladder).exists() else [])
