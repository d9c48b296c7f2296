"""Writes ro-crate-metadata.json: files with their digests, programs, and the jobs that ran.

RO-Crate 1.1 (https://w3id.org/ro/crate/1.1) says how: a flat list of entities in JSON-LD with the
terms of schema.org, joined by their "@id".
"""

import mimetypes
import shutil
from datetime import datetime, timezone
from pathlib import Path

from crate.actions import Action, actions_of, provenance_in
from file_digest import sha256_of
from json_file import write_json

NAME = "ro-crate-metadata.json"
CONTEXT = "https://w3id.org/ro/crate/1.1/context"
PROFILE = "https://w3id.org/ro/crate/1.1"
STUDY_FOLDER = "study"  # copies of study.yaml, the table and outlines, inside the crate
# Runs in chunks are left out: the crate has the database that they were joined to.
JOINED = {
    "chunks": "database.h5",
    "further_chunks": "database.h5",
    "better_chunks": "better.h5",
    "signature_chunks": "signatures.h5",
}
LEFT_OUT = {"logs", *JOINED}
MEDIA_TYPES = {
    ".h5": "application/x-hdf5",
    ".yaml": "application/yaml",
    ".tsv": "text/tab-separated-values",
}


def write_manifest(study: dict, experiments: Path, results: Path) -> Path:
    """Copies what the study was made of beside its results and describes both."""
    copy = results / STUDY_FOLDER
    if copy.exists():
        shutil.rmtree(copy)
    shutil.copytree(experiments, copy)
    files = [path for path in sorted(results.rglob("*")) if _belongs(path, results)]
    path = results / NAME
    write_json(path, {"@context": CONTEXT, "@graph": graph(study, experiments, results, files)})
    return path


def _belongs(path: Path, results: Path) -> bool:
    inside = path.relative_to(results)
    waste = path.name.endswith((".tmp", ".jsonl")) or ".checkpoint" in path.name
    return path.is_file() and path.name != NAME and not waste and not LEFT_OUT & set(inside.parts)


def _chunks(results: Path) -> list[tuple[Path, Path]]:
    """Each chunk of runs, and the database that it was joined to."""
    return [
        (chunk, folder.parent / JOINED[folder.name])
        for folder in sorted(results.rglob("*chunks"))
        if folder.name in JOINED
        for chunk in sorted(folder.glob("*.h5"))
    ]


def graph(study: dict, experiments: Path, results: Path, files: list[Path]) -> list[dict]:
    names = {str(path): path.relative_to(results).as_posix() for path in files}
    names |= {str(path): names[str(whole)] for path, whole in _chunks(results) if whole in files}
    actions = actions_of(list(names))
    # The study's own files count as their copies.
    for path in experiments.rglob("*"):
        names[str(path)] = f"{STUDY_FOLDER}/{path.relative_to(experiments).as_posix()}"
    software = _software(actions)
    jobs = [_job(number, action, names) for number, action in enumerate(actions)]
    root = {
        "@id": "./",
        "@type": "Dataset",
        "name": study["title"],
        "description": study["about"] or f"Calibration of {study['material']} by Taylor impacts",
        "datePublished": datetime.now(timezone.utc).date().isoformat(),
        "license": "to be chosen by the authors",
        "hasPart": [{"@id": names[str(path)]} for path in files],
        "mentions": [{"@id": job["@id"]} for job in jobs],
    }
    descriptor = {
        "@id": NAME,
        "@type": "CreativeWork",
        "conformsTo": {"@id": PROFILE},
        "about": {"@id": "./"},
    }
    entities = [_file(path, names[str(path)]) for path in files]
    return [descriptor, root, *entities, *software, *jobs]


def _file(path: Path, name: str) -> dict:
    media = MEDIA_TYPES.get(path.suffix) or mimetypes.guess_type(path.name)[0]
    entity = {
        "@id": name,
        "@type": "File",
        "name": path.name,
        "contentSize": str(path.stat().st_size),
        "sha256": sha256_of(path),
        "encodingFormat": media or "application/octet-stream",
    }
    provenance = provenance_in(path)
    if provenance:
        entity["additionalProperty"] = [
            {"@type": "PropertyValue", "name": key, "value": value}
            for key, value in provenance.items()
        ]
    return entity


def _software_id(name: str, code: str) -> str:
    return f"#{name}-{code}"


def _software(actions: list[Action]) -> list[dict]:
    """Programs and scripts by the digest of their sources."""
    found = {(name, code) for action in actions for name, code in action.code.items()}
    return [
        {
            "@id": _software_id(name, code),
            "@type": "SoftwareApplication",
            "name": f"taylorcal {name}",
            "softwareVersion": f"code {code}",
        }
        for name, code in sorted(found)
    ]


def _job(number: int, action: Action, names: dict[str, str]) -> dict:
    results = dict.fromkeys(names[file] for file in action.outputs)
    read = dict.fromkeys(names[file] for file in action.inputs if file in names)
    entity = {
        "@id": f"#job-{number}-{action.rule}",
        "@type": "CreateAction",
        "name": action.rule,
        "description": action.command,
        "startTime": action.start,
        "endTime": action.end,
        "instrument": [{"@id": _software_id(*item)} for item in action.code.items()],
        "object": [{"@id": name} for name in read if name not in results],
        "result": [{"@id": name} for name in results],
    }
    costs = {"wall seconds": action.job.wall_s, "CPU seconds": action.job.cpu_s}
    entity["additionalProperty"] = [
        {"@type": "PropertyValue", "name": name, "value": value, "unitCode": "SEC"}
        for name, value in costs.items()
        if value is not None
    ]
    if action.job.host:
        machine = {"@type": "PropertyValue", "name": "machine", "value": action.job.host}
        entity["additionalProperty"].append(machine)
    return entity
