# A second round of runs, in studies that ask for it (`database.near_posterior`): a first network
# and posterior say where the table's answer lies, and runs there, of the solver that the network
# answers as, join the others before the network is trained that counts.
rule first_train:
    input:
        program=ancient("build/bin/emulator"),
        database=with_scores("database"),
        better=first_better_of,
        settings="results/{study}/config/train.json",
    output:
        "results/{study}/first_emulator.json",
    log:
        "results/{study}/logs/first_train.log",
    benchmark:
        "results/{study}/benchmarks/first_train.tsv"
    params:
        code=code_of("emulator"),
        better=lambda wildcards, input: f"--better {input.better}" if input.better else "",
    threads: workflow.cores
    shell:
        logged(
            "{input.program} train {input.database} --config {input.settings} {params.better}"
            " --out {output} --threads {threads}"
        )


rule first_sample:
    input:
        program=ancient("build/bin/calibrate"),
        emulator="results/{study}/first_emulator.json",
        measurements=fitted_table_of,
        settings="results/{study}/config/calibrate.json",
    output:
        "results/{study}/first_posterior.h5",
    log:
        "results/{study}/logs/first_sample.log",
    benchmark:
        "results/{study}/benchmarks/first_sample.tsv"
    params:
        code=code_of("calibrate"),
    threads: workflow.cores
    shell:
        logged(
            "{input.program} sample --emulator {input.emulator} --measurements {input.measurements}"
            " --config {input.settings} --out {output} --threads {threads}"
        )


rule near_design:
    input:
        posterior="results/{study}/first_posterior.h5",
        measurements=measurements_of,
    output:
        "results/{study}/near_design.h5",
    log:
        "results/{study}/logs/near_design.log",
    params:
        settings=near_design_settings_of,
        **python_script("make_near_design.py"),
    script:
        "../scripts/{params.script}"


rule near_runs:
    input:
        program=ancient("build/bin/solver"),
        design="results/{study}/near_design.h5",
        settings=best_solver_of,
    output:
        "results/{study}/near_runs.h5",
    log:
        "results/{study}/logs/near_runs.log",
    benchmark:
        "results/{study}/benchmarks/near_runs.tsv"
    params:
        code=code_of("solver"),
        rows=near_rows_of,
    threads: workflow.cores
    shell:
        logged(
            "{input.program} batch {input.design} --config {input.settings} --out {output}"
            " --rows {params.rows} --threads {threads}"
        )


rule with_near:
    input:
        program=ancient("build/bin/solver"),
        runs=joined_with_near,
    output:
        "results/{study}/with_near.h5",
    log:
        "results/{study}/logs/with_near.log",
    params:
        code=code_of("solver"),
        effects=zero_inputs_of,
    shell:
        logged(
            "{input.program} merge {input.runs} {params.effects} --out {output}"
        )
