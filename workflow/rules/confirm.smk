# Direct runs of the solver at the posterior maximum: is the network believed too much?
rule confirmation_design:
    input:
        posterior="results/{study}/posterior.h5",
        measurements=measurements_of,
        settings="results/{study}/config/calibrate.json",
    output:
        "results/{study}/confirmation_design.h5",
    log:
        "results/{study}/logs/confirmation_design.log",
    params:
        seed=lambda wildcards: study_of(wildcards.study)["database"]["seed"],
        **python_script("make_confirmation_design.py"),
    script:
        "../scripts/{params.script}"


rule confirmation_runs:
    input:
        program=ancient("build/bin/solver"),
        design="results/{study}/confirmation_design.h5",
        settings=best_solver_of,
    output:
        "results/{study}/confirmation_runs.h5",
    log:
        "results/{study}/logs/confirmation_runs.log",
    benchmark:
        "results/{study}/benchmarks/confirmation_runs.tsv"
    params:
        code=code_of("solver"),
    threads: workflow.cores
    shell:
        logged(
            "{input.program} batch {input.design} --config {input.settings} --out {output}"
            " --threads {threads}"
        )


rule confirm:
    input:
        runs=with_scores("confirmation_runs"),
        comparison="results/{study}/comparison.json",
        measurements=fitted_table_of,
    output:
        "results/{study}/confirmation.json",
    log:
        "results/{study}/logs/confirm.log",
    params:
        **python_script("make_confirmation.py"),
    script:
        "../scripts/{params.script}"
