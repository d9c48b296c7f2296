rule settings:
    output:
        "results/{study}/config/{stage}.json",
    log:
        "results/{study}/logs/settings_{stage}.log",
    params:
        settings=stage_settings,
        **python_script("write_settings.py"),
    script:
        "../scripts/{params.script}"


rule design:
    output:
        "results/{study}/design.h5",
    log:
        "results/{study}/logs/design.log",
    benchmark:
        "results/{study}/benchmarks/design.tsv"
    params:
        settings=design_settings_of,
        **python_script("make_design.py"),
    script:
        "../scripts/{params.script}"
