# The chain from a study to its report:
#   snakemake --cores all --config study=copper_measured
#   snakemake --cores all results/paper_design/report.html
#   snakemake --cores all results/paper_design/diagnosis.html
configfile: "workflow/config.yaml"


include: "workflow/rules/common.smk"
include: "workflow/rules/common_revisions.smk"
include: "workflow/rules/common_near.smk"
include: "workflow/rules/common_signatures.smk"
include: "workflow/rules/common_pages.smk"
include: "workflow/rules/design.smk"
include: "workflow/rules/runs.smk"
include: "workflow/rules/further.smk"
include: "workflow/rules/better.smk"
include: "workflow/rules/outlines.smk"
include: "workflow/rules/emulator.smk"
include: "workflow/rules/sample.smk"
include: "workflow/rules/near_posterior.smk"
include: "workflow/rules/compare.smk"
include: "workflow/rules/confirm.smk"
include: "workflow/rules/ladder.smk"
include: "workflow/rules/diagnose.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/diagnosis_page.smk"


# What takes seconds is not worth a job of a cluster.
localrules:
    all,
    settings,
    design,
    further_design,
    better_design,
    merge,
    better,
    near_design,
    with_near,
    outline_basis,
    score_database,
    score_measurements,
    compare,
    confirmation_design,
    confirm,
    ladder,
    candidates,
    signature_design,
    signatures,
    report,
    diagnosis_page,


rule all:
    default_target: True
    input:
        targets_of_study(config["study"]),
