# A chunk takes all cores: the solver hands its runs to the threads one by one, which
# balances better than one thread a chunk. On a cluster: `--set-threads runs=N`. A killed
# chunk goes on from {chunk}.h5.journal.jsonl, which is not an output on purpose.
rule runs:
    input:
        program=ancient("build/bin/solver"),
        design="results/{study}/design.h5",
        settings="results/{study}/config/solver.json",
    output:
        "results/{study}/chunks/{chunk}.h5",
    log:
        "results/{study}/logs/runs_{chunk}.log",
    benchmark:
        "results/{study}/benchmarks/runs_{chunk}.tsv"
    params:
        code=code_of("solver"),
        rows=rows_of_chunk,
    threads: workflow.cores
    shell:
        logged(
            "{input.program} batch {input.design} --config {input.settings} --out {output}"
            " --rows {params.rows} --threads {threads}"
        )


rule merge:
    input:
        program=ancient("build/bin/solver"),
        previous=previous_database_of,
        chunks=chunks_of,
    output:
        "results/{study}/database.h5",
    log:
        "results/{study}/logs/merge.log",
    benchmark:
        "results/{study}/benchmarks/merge.tsv"
    params:
        code=code_of("solver"),
        # The runs of the revision before have no column of the effect: its amplitude is 0.
        effects=zero_inputs_of,
    shell:
        logged(
            "{input.program} merge {input.previous} {input.chunks} {params.effects} --out {output}"
        )
