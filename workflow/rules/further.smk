# Runs beside those of the database, in studies that have some (`database.further`): shots of another
# shape or beyond a range need not make the database anew. Each part is a chunk of its own.
rule further_design:
    output:
        "results/{study}/further_design_{part}.h5",
    log:
        "results/{study}/logs/further_design_{part}.log",
    params:
        settings=further_design_settings_of,
        **python_script("make_design.py"),
    script:
        "../scripts/{params.script}"


rule further_runs:
    input:
        program=ancient("build/bin/solver"),
        design="results/{study}/further_design_{part}.h5",
        settings="results/{study}/config/solver.json",
    output:
        "results/{study}/further_chunks/{part}.h5",
    log:
        "results/{study}/logs/further_runs_{part}.log",
    benchmark:
        "results/{study}/benchmarks/further_runs_{part}.tsv"
    params:
        code=code_of("solver"),
        rows=rows_of_part,
    threads: workflow.cores
    shell:
        logged(
            "{input.program} batch {input.design} --config {input.settings} --out {output}"
            " --rows {params.rows} --threads {threads}"
        )
