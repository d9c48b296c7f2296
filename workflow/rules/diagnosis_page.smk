# diagnosis.html: what is missing, and what adding it did. Asked for by name only, so that the
# report of a study stays as cheap as it is.
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
        **python_script("make_diagnosis_page.py"),
    script:
        "../scripts/{params.script}"
