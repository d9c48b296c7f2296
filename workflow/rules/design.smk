rule settings:
    output:
        "results/{study}/config/{stage}.json",
    log:
        "results/{study}/logs/settings_{stage}.log",
    params:
        settings=stage_settings,
    script:
        "../scripts/write_settings.py"


rule design:
    output:
        "results/{study}/design.h5",
    log:
        "results/{study}/logs/design.log",
    benchmark:
        "results/{study}/benchmarks/design.tsv"
    params:
        settings=design_settings_of,
    script:
        "../scripts/make_design.py"
