"""The estimate at the end of Snakemake's dry runs, which call no handler of their own."""

import atexit
import re

from cost.model import study_cost
from cost.words import cost_words
from input_errors import InputError

# As such, or among short options that take no value: -n, -np, -rn.
DRY_RUN = re.compile(r"--dry-?run|-[npqrFRk]*n[npqrFRk]*")


def tell_cost_in_dry_run(name: str, study: dict, arguments: list[str]) -> None:
    """`arguments`: of Snakemake's command line; its jobs have none of them."""
    if any(DRY_RUN.fullmatch(word) for word in arguments):
        try:
            words = cost_words(name, study, study_cost(study))
        except InputError as error:  # a kind of run that nobody has measured
            words = str(error)
        atexit.register(lambda: print(f"\n{words}", flush=True))
