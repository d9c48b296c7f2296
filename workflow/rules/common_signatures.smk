# What the rules of a diagnosis share: the candidates and the runs that show them.
from candidates import candidates, typical_amplitudes
from make_signature_design import shapes_in_use
from study import has_finer


def candidates_of(wildcards):
    study = study_of(wildcards.study)
    try:
        entries = candidates(study, solver_list("effects"), solver_list("parameters"))
    except InputError as error:
        raise WorkflowError(str(error))
    return {"candidates": entries}


def signature_settings(wildcards):
    study = study_of(wildcards.study)
    settings = {"points_per_shape": study["diagnosis"]["points_per_shape"]}
    settings["seed"] = study["database"]["seed"]
    return {**settings, "typical": typical_amplitudes(study, solver_list("effects"))}


def signature_runs_of(wildcards):
    """Their number, known before the posterior is."""
    shapes = shapes_in_use(read_measurements(Path(measurements_of(wildcards))))
    points = len(shapes) * study_of(wildcards.study)["diagnosis"]["points_per_shape"]
    return points * (1 + len(candidates_of(wildcards)["candidates"]))


def signature_chunk_count(wildcards):
    return min(study_of(wildcards.study)["database"]["chunks"], signature_runs_of(wildcards))


def signature_rows_of_chunk(wildcards):
    runs = signature_runs_of(wildcards)
    return share_of_chunk(runs, signature_chunk_count(wildcards), wildcards)


def signature_chunks_of(wildcards):
    chunks = range(signature_chunk_count(wildcards))
    name = "results/{study}/signature_chunks/{chunk}.h5"
    return expand(name, chunk=chunks, study=wildcards.study)


def finer_of(wildcards):
    """No run is finer than the finest fidelity."""
    finer = has_finer(study_of(wildcards.study))
    return with_scores("signatures_finer")(wildcards) if finer else []
