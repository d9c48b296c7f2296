rule train:
    input:
        program=ancient("build/bin/emulator"),
        database=database_of,
        better=better_of,
        previous=previous("emulator.json"),
        settings="results/{study}/config/train.json",
    output:
        "results/{study}/emulator.json",
    log:
        "results/{study}/logs/train.log",
    benchmark:
        "results/{study}/benchmarks/train.tsv"
    params:
        code=code_of("emulator"),
        better=lambda wildcards, input: f"--better {input.better}" if input.better else "",
        start=lambda wildcards, input: f"--from {input.previous}" if input.previous else "",
    threads: workflow.cores
    shell:
        logged(
            "{input.program} train {input.database} --config {input.settings} {params.better}"
            " {params.start}"
            " --out {output} --threads {threads}"
        )
