"""What a study costs before it starts, from measured costs of runs."""
