"""Why Snakemake would run a stage of a study, in words."""
