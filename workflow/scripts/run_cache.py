"""Which folder of finished runs the solver shares with other studies and users."""

import os


def use_run_cache(folder: str) -> None:
    """Tells the jobs to come. Not a parameter of their rules, since which runs are taken from a
    cache changes no result.
    """
    if folder:
        os.environ["TAYLORCAL_RUN_CACHE"] = folder
