"""Training speed of the network beside PyTorch's on this machine: the same layout, batch, data,
number of networks and threads, in one run. Usage: bench_training.py EMULATOR
"""

import json
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

ROWS, INPUTS, SHAPES, OUTPUTS = 2350, 4, 4, 5
LAYERS, NEURONS, BATCH, MEMBERS = 7, 21, 32, 2
EPOCHS = 40
VALIDATION = 350


def make_data(seed=1):
    """Inputs in the unit cube, a shape each, and smooth outputs."""
    random = np.random.default_rng(seed)
    inputs = random.random((ROWS, INPUTS))
    shape = random.integers(SHAPES, size=ROWS)
    waves = random.normal(size=(SHAPES, OUTPUTS, INPUTS))
    phase = np.einsum("noi,ni->no", waves[shape], inputs)
    return inputs, shape, 10 + np.sin(2 * phase)


def write_database(path, inputs, shape, outputs):
    text = h5py.string_dtype(encoding="utf-8")
    with h5py.File(path, "w") as file:
        file.attrs["schema"] = "taylorcal/database/1"
        file["run_id"] = np.arange(ROWS)
        file["status"] = np.zeros(ROWS, dtype=np.int64)
        file.create_dataset("shape", data=[f"shape_{k}" for k in shape], dtype=text)
        file["inputs"], file["outputs"] = inputs, outputs
        file["inputs"].attrs.create("names", [f"x{i}" for i in range(INPUTS)], dtype=text)
        file["outputs"].attrs.create("names", [f"y{i}" for i in range(OUTPUTS)], dtype=text)


def rate_of_emulator(emulator, data, folder, threads):
    """Samples a second, as `emulator train` states them."""
    write_database(folder / "database.h5", *data)
    config = {
        "inputs": [{"name": f"x{i}"} for i in range(INPUTS)],
        "category": "shape",
        "outputs": [{"name": f"y{i}"} for i in range(OUTPUTS)],
        "hidden_layers": LAYERS,
        "neurons": NEURONS,
        "members": MEMBERS,
        "epochs": EPOCHS * 10,
        "batch_sizes": [BATCH],
        "learning_rates": [0.005],
        "validation_fraction": VALIDATION / ROWS,
    }
    (folder / "train.json").write_text(json.dumps(config))
    command = [emulator, "train", folder / "database.h5", "--config", folder / "train.json"]
    command += ["--out", folder / "emulator.json", "--threads", str(threads)]
    log = subprocess.run(command, check=True, capture_output=True, text=True).stderr
    return 1e3 * float(re.search(r"(\d+) thousand samples a second", log).group(1))


def rate_of_torch(data, threads):
    """Samples a second of the usual loop: one network after the other on all threads."""
    import torch

    torch.set_num_threads(threads)
    inputs, shape, outputs = data
    hot = np.eye(SHAPES)[shape]
    x = torch.tensor(np.hstack([inputs, hot]), dtype=torch.float32)[VALIDATION:]
    y = torch.tensor((outputs - 10) / outputs.std(), dtype=torch.float32)[VALIDATION:]
    widths = [INPUTS + SHAPES, *[NEURONS] * LAYERS]
    steps = []
    for wide, narrow in zip(widths, widths[1:]):
        steps += [torch.nn.Linear(wide, narrow), torch.nn.SiLU()]
    network = torch.nn.Sequential(*steps, torch.nn.Linear(NEURONS, OUTPUTS))
    adam = torch.optim.AdamW(network.parameters(), lr=0.005)
    start, shown = time.perf_counter(), 0
    for _ in range(EPOCHS // 10):
        order = torch.randperm(len(x))
        for first in range(0, len(x), BATCH):
            rows = order[first : first + BATCH]
            adam.zero_grad()
            loss = ((network(x[rows]) - y[rows]) ** 2).mean()
            loss.backward()
            adam.step()
            shown += len(rows)
    return shown / (time.perf_counter() - start)


def main():
    emulator, threads = Path(sys.argv[1]).resolve(), 2
    data = make_data()
    layout = f"{INPUTS} + {SHAPES} inputs, {LAYERS} x {NEURONS}, {OUTPUTS} outputs"
    print(f"training {MEMBERS} networks of {layout}, batches of {BATCH}, {threads} threads")
    with tempfile.TemporaryDirectory() as folder:
        ours = rate_of_emulator(emulator, data, Path(folder), threads)
    print(f"  emulator train: {1e-3 * ours:.0f} thousand samples a second")
    try:
        theirs = {number: rate_of_torch(data, number) for number in (1, threads)}
    except ImportError:
        print("  PyTorch is not here to compare with: apt-get install python3-torch")
        return
    for number, rate in theirs.items():
        # One network on each thread, as the members of an ensemble are trained here.
        networks = threads if number == 1 else 1
        alike = "one network a thread" if number == 1 else "one network on all threads"
        print(
            f"  PyTorch, {alike}: {1e-3 * rate * networks:.0f} thousand samples a second, "
            f"{ours / (rate * networks):.1f} times slower"
        )


if __name__ == "__main__":
    main()
