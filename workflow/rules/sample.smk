rule sample:
    input:
        program=ancient("build/bin/calibrate"),
        emulator="results/{study}/emulator.json",
        measurements=fitted_table_of,
        settings="results/{study}/config/calibrate.json",
    output:
        "results/{study}/posterior.h5",
    log:
        "results/{study}/logs/sample.log",
    benchmark:
        "results/{study}/benchmarks/sample.tsv"
    params:
        code=code_of("calibrate"),
    threads: workflow.cores
    shell:
        logged(
            "{input.program} sample --emulator {input.emulator} --measurements {input.measurements}"
            " --config {input.settings} --out {output} --threads {threads}"
        )
