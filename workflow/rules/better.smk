# Runs of a better solver, in studies that have some (`database.better`): the network answers
# as that one, and learns from the cheaper runs what both have in common.
rule better_design:
    output:
        "results/{study}/better_design.h5",
    log:
        "results/{study}/logs/better_design.log",
    params:
        settings=better_design_settings_of,
        **python_script("make_design.py"),
    script:
        "../scripts/{params.script}"


rule better_runs:
    input:
        program=ancient("build/bin/solver"),
        design="results/{study}/better_design.h5",
        settings="results/{study}/config/solver_better.json",
    output:
        "results/{study}/better_chunks/{chunk}.h5",
    log:
        "results/{study}/logs/better_runs_{chunk}.log",
    benchmark:
        "results/{study}/benchmarks/better_runs_{chunk}.tsv"
    params:
        code=code_of("solver"),
        rows=better_rows_of_chunk,
    threads: workflow.cores
    shell:
        logged(
            "{input.program} batch {input.design} --config {input.settings} --out {output}"
            " --rows {params.rows} --threads {threads}"
        )


# A revision takes those of the base, with an amplitude of 0.
rule better:
    input:
        program=ancient("build/bin/solver"),
        runs=better_chunks_of,
    output:
        "results/{study}/better.h5",
    log:
        "results/{study}/logs/better.log",
    params:
        code=code_of("solver"),
        effects=zero_inputs_of,
    shell:
        logged(
            "{input.program} merge {input.runs} {params.effects} --out {output}"
        )
