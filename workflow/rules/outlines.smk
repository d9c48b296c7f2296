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
    params:
        **python_script("make_outline_basis.py"),
    script:
        "../scripts/{params.script}"


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
    params:
        **python_script("score_database.py"),
    script:
        "../scripts/{params.script}"


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
        **python_script("score_measurements.py"),
    script:
        "../scripts/{params.script}"
