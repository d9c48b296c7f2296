# diagnosis.html: what is missing, and what adding it did. Asked for by name only, so that the
# report of a study stays as cheap as it is.
from revisions import revision_ids


def ladder_of(wildcards):
    """The study's ladder; none before an effect was added."""
    name, _ = split_home(wildcards.study)
    return f"results/{name}/ladder.json" if study_of(name)["effects"] else []


def confirmations_of(wildcards):
    name, _ = split_home(wildcards.study)
    if not study_of(name)["effects"]:
        return []
    return [f"results/{home}/confirmation.json" for home in homes_of_study(name)]


def revisions_of_page(wildcards):
    """The ids that belong to `confirmations_of`."""
    name, _ = split_home(wildcards.study)
    effects = study_of(name)["effects"]
    return revision_ids(effects) if effects else []


rule diagnosis_page:
    input:
        diagnosis="results/{study}/diagnosis.json",
        next_experiment="results/{study}/next_experiment.json",
        candidates="results/{study}/candidates.json",
        comparison="results/{study}/comparison.json",
        settings="results/{study}/config/report.json",
        ladder=ladder_of,
        confirmations=confirmations_of,
        page="workflow/report/diagnosis.html.j2",
        base="workflow/report/base.html.j2",
        figure="workflow/report/figure.html.j2",
        style="workflow/report/style.css",
    output:
        page="results/{study}/diagnosis.html",
        plots=directory("results/{study}/diagnosis_plots"),
    log:
        "results/{study}/logs/diagnosis_page.log",
    params:
        revisions=revisions_of_page,
    script:
        "../scripts/make_diagnosis_page.py"
