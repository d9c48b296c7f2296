# 3D runs of paper_design's ranges: do few of them correct a network of many axisymmetric ones?
from draw_three_dimensions import settings_of
from study import load_study


rule three_dimensional_design:
    output:
        design="results/verification/three_dimensions/design.h5",
        settings="results/verification/three_dimensions/solver.json",
    log:
        "results/verification/logs/three_dimensional_design.log",
    params:
        settings=settings_of(load_study("paper_design")),
    script:
        "studies/draw_three_dimensions.py"


rule three_dimensional_runs:
    input:
        design="results/verification/three_dimensions/design.h5",
        settings="results/verification/three_dimensions/solver.json",
    output:
        "results/verification/three_dimensions/runs.h5",
    log:
        "results/verification/logs/three_dimensional_runs.log",
    params:
        code=code_of("solver"),
    threads: workflow.cores
    shell:
        "build/bin/solver batch {input.design} --config {input.settings} --out {output}"
        " --threads {threads} > {log} 2>&1"


rule three_dimensional_repeat_design:
    input:
        "results/verification/three_dimensions/runs.h5",
    output:
        "results/verification/three_dimensions/repeat_design.h5",
    log:
        "results/verification/logs/three_dimensional_repeat_design.log",
    script:
        "studies/draw_repeats.py"


rule three_dimensional_repeat_runs:
    input:
        design="results/verification/three_dimensions/repeat_design.h5",
        settings="results/verification/three_dimensions/solver.json",
    output:
        "results/verification/three_dimensions/repeats.h5",
    log:
        "results/verification/logs/three_dimensional_repeat_runs.log",
    params:
        code=code_of("solver"),
    threads: workflow.cores
    shell:
        "build/bin/solver batch {input.design} --config {input.settings} --out {output}"
        " --threads {threads} > {log} 2>&1"


rule three_dimensions:
    input:
        database=ancient("results/paper_design/database.h5"),
        runs="results/verification/three_dimensions/runs.h5",
        repeats="results/verification/three_dimensions/repeats.h5",
        train=ancient("results/paper_design/config/train.json"),
    output:
        table="results/verification/three_dimensions.csv",
        scatter="results/verification/three_dimensions_scatter.csv",
        figure="results/verification/three_dimensions.png",
    log:
        "results/verification/logs/three_dimensions.log",
    params:
        code=code_of("emulator"),
    script:
        "studies/three_dimensions.py"
