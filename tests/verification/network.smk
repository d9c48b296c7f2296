# Studies of what results/paper_design holds, without a run of the solver.


# Where the network errs, and whether its members know.
rule network_errors:
    input:
        emulator="results/paper_design/emulator.json",
        near=ancient("results/paper_design/near_runs.h5"),
    output:
        text="results/verification/network_errors.txt",
        table="results/verification/network_errors.csv",
        regions="results/verification/network_errors_regions.csv",
        coverage="results/verification/network_errors_coverage.csv",
        correlation="results/verification/network_correlation.png",
        figure="results/verification/network_errors.png",
    log:
        "results/verification/logs/network_errors.log",
    script:
        "studies/network_errors.py"


# The source paper's loss beside ours; needs PyTorch (apt-get install python3-torch).
rule losses:
    input:
        database=ancient("results/paper_design/database.h5"),
        better=ancient("results/paper_design/better.h5"),
        train=ancient("results/paper_design/config/train.json"),
    output:
        text="results/verification/losses.txt",
        table="results/verification/losses.csv",
        figure="results/verification/losses.png",
    log:
        "results/verification/logs/losses.log",
    script:
        "studies/losses.py"


# What the second round of runs, near a first posterior, did to network and posterior.
rule second_round:
    input:
        first=ancient("results/paper_design/first_emulator.json"),
        emulator="results/paper_design/emulator.json",
        near=ancient("results/paper_design/near_runs.h5"),
        first_posterior=ancient("results/paper_design/first_posterior.h5"),
        posterior="results/paper_design/posterior.h5",
    output:
        text="results/verification/second_round.txt",
        figure="results/verification/second_round.png",
    log:
        "results/verification/logs/second_round.log",
    script:
        "studies/second_round.py"
