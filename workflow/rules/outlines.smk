# Measured outlines r(z), compared as scores of the principal components of the computed ones.
# These rules run only in studies whose emulator learns a score; see `uses_outlines`.
rule outline_basis:
    input:
        database="results/{study}/database.h5",
    output:
        "results/{study}/outlines/basis.json",
    log:
        "results/{study}/logs/outline_basis.log",
    benchmark:
        "results/{study}/benchmarks/outline_basis.tsv"
    script:
        "../scripts/make_outline_basis.py"


rule score_database:
    input:
        database="results/{study}/{name}.h5",
        basis=base_outlines_of,
    output:
        "results/{study}/outlines/{name,[A-Za-z0-9_]+}.h5",
    log:
        "results/{study}/logs/score_{name}.log",
    benchmark:
        "results/{study}/benchmarks/score_{name}.tsv"
    script:
        "../scripts/score_database.py"


rule score_measurements:
    input:
        measurements=measurements_of,
        outlines=outlines_of,
        basis=base_outlines_of,
    output:
        table="results/{study}/outlines/measurements.csv",
        scores="results/{study}/outlines/scores.json",
    log:
        "results/{study}/logs/score_measurements.log",
    benchmark:
        "results/{study}/benchmarks/score_measurements.tsv"
    params:
        errors=outline_errors_of,
    script:
        "../scripts/score_measurements.py"
