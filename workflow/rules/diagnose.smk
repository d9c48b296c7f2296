# Which missing effect would explain the residuals? Pairs of runs with and without each
# candidate (signatures), then the search itself. Nothing here reruns the calibration.
rule candidates:
    output:
        "results/{study}/candidates.json",
    log:
        "results/{study}/logs/candidates.log",
    params:
        settings=candidates_of,
        **python_script("write_settings.py"),
    script:
        "../scripts/{params.script}"


rule signature_design:
    input:
        posterior="results/{study}/posterior.h5",
        measurements=measurements_of,
        settings="results/{study}/config/calibrate.json",
        candidates="results/{study}/candidates.json",
    output:
        design="results/{study}/signature_design.h5",
        finer="results/{study}/signature_design_finer.h5",
    log:
        "results/{study}/logs/signature_design.log",
    params:
        settings=signature_settings,
        **python_script("make_signature_design.py"),
    script:
        "../scripts/{params.script}"


rule signature_runs:
    input:
        program=ancient("build/bin/solver"),
        design="results/{study}/signature_design.h5",
        settings="results/{study}/config/solver.json",
    output:
        "results/{study}/signature_chunks/{chunk}.h5",
    log:
        "results/{study}/logs/signature_runs_{chunk}.log",
    benchmark:
        "results/{study}/benchmarks/signature_runs_{chunk}.tsv"
    params:
        code=code_of("solver"),
        rows=signature_rows_of_chunk,
    threads: workflow.cores
    shell:
        logged(
            "{input.program} batch {input.design} --config {input.settings} --out {output}"
            " --rows {params.rows} --threads {threads}"
        )


rule signatures:
    input:
        program=ancient("build/bin/solver"),
        chunks=signature_chunks_of,
    output:
        "results/{study}/signatures.h5",
    log:
        "results/{study}/logs/signatures.log",
    params:
        code=code_of("solver"),
    shell:
        logged(
            "{input.program} merge {input.chunks} --out {output}"
        )


rule signatures_finer:
    input:
        program=ancient("build/bin/solver"),
        design="results/{study}/signature_design_finer.h5",
        settings="results/{study}/config/solver_finer.json",
    output:
        "results/{study}/signatures_finer.h5",
    log:
        "results/{study}/logs/signatures_finer.log",
    benchmark:
        "results/{study}/benchmarks/signatures_finer.tsv"
    params:
        code=code_of("solver"),
    threads: workflow.cores
    shell:
        logged(
            "{input.program} batch {input.design} --config {input.settings} --out {output}"
            " --threads {threads}"
        )


rule diagnose:
    input:
        program=ancient("build/bin/calibrate"),
        emulator="results/{study}/emulator.json",
        measurements=fitted_table_of,
        settings="results/{study}/config/calibrate.json",
        posterior="results/{study}/posterior.h5",
        signatures=with_scores("signatures"),
        finer=finer_of,
        candidates="results/{study}/candidates.json",
    output:
        "results/{study}/diagnosis.json",
    log:
        "results/{study}/logs/diagnose.log",
    benchmark:
        "results/{study}/benchmarks/diagnose.tsv"
    params:
        code=code_of("calibrate"),
        finer=lambda wildcards, input: f"--finer {input.finer}" if input.finer else "",
    threads: workflow.cores
    shell:
        logged(
            "{input.program} diagnose --emulator {input.emulator} --measurements {input.measurements}"
            " --config {input.settings} --posterior {input.posterior}"
            " --signatures {input.signatures} {params.finer} --candidates {input.candidates}"
            " --out {output} --threads {threads}"
        )


rule next_experiment:
    input:
        program=ancient("build/bin/calibrate"),
        diagnosis="results/{study}/diagnosis.json",
        emulator="results/{study}/emulator.json",
        measurements=fitted_table_of,
        settings="results/{study}/config/calibrate.json",
        posterior="results/{study}/posterior.h5",
        signatures=with_scores("signatures"),
        finer=finer_of,
        candidates="results/{study}/candidates.json",
    output:
        "results/{study}/next_experiment.json",
    log:
        "results/{study}/logs/next_experiment.log",
    benchmark:
        "results/{study}/benchmarks/next_experiment.tsv"
    params:
        code=code_of("calibrate"),
        finer=lambda wildcards, input: f"--finer {input.finer}" if input.finer else "",
    shell:
        logged(
            "{input.program} design --diagnosis {input.diagnosis} --emulator {input.emulator}"
            " --measurements {input.measurements} --config {input.settings}"
            " --posterior {input.posterior} --signatures {input.signatures} {params.finer}"
            " --candidates {input.candidates} --out {output}"
        )
