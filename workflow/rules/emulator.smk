rule train:
    input:
        program="build/bin/emulator",
        database=training_database_of,
        settings="results/{study}/config/train.json",
    output:
        "results/{study}/emulator.json",
    log:
        "results/{study}/logs/train.log",
    benchmark:
        "results/{study}/benchmarks/train.tsv"
    threads: workflow.cores
    shell:
        "{input.program} train {input.database} --config {input.settings} --out {output}"
        " --threads {threads} > {log} 2>&1"
