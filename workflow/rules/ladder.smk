# The revisions side by side: does the error fall?
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
        **python_script("make_ladder.py"),
    script:
        "../scripts/{params.script}"
