rule compare:
    input:
        program=ancient("build/bin/calibrate"),
        posterior="results/{study}/posterior.h5",
        emulator="results/{study}/emulator.json",
        measurements=fitted_table_of,
        settings="results/{study}/config/calibrate.json",
    output:
        "results/{study}/comparison.json",
    log:
        "results/{study}/logs/compare.log",
    benchmark:
        "results/{study}/benchmarks/compare.tsv"
    params:
        code=code_of("calibrate"),
    shell:
        logged(
            "{input.program} compare --posterior {input.posterior} --emulator {input.emulator}"
            " --measurements {input.measurements} --config {input.settings} --out {output}"
        )
