# The revisions side by side: does the error fall?
def ladder_inputs(file):
    def find(wildcards):
        return [f"results/{home}/{file}" for home in homes_of_study(wildcards.name)]

    return find


rule ladder:
    input:
        comparisons=ladder_inputs("comparison.json"),
        posteriors=ladder_inputs("posterior.h5"),
        databases=ladder_inputs("database.h5"),
        confirmations=ladder_inputs("confirmation.json"),
    output:
        "results/{name}/ladder.json",
    log:
        "results/{name}/logs/ladder.log",
    params:
        effects=lambda wildcards: study_of(wildcards.name)["effects"],
    script:
        "../scripts/make_ladder.py"


def targets_of_study(name):
    """The base's report; with effects added also the last revision's, and the ladder."""
    homes = homes_of_study(name)
    targets = [f"results/{home}/report.html" for home in dict.fromkeys([homes[0], homes[-1]])]
    return targets + ([f"results/{name}/ladder.json"] if len(homes) > 1 else [])
