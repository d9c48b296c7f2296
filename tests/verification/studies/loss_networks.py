"""Networks of one layout trained side by side by PyTorch, each with a loss, a learning rate and a
seed of its own. Networks of one seed start from the same weights and see the same batches.
"""

import numpy as np

try:
    import torch
    from torch.nn.functional import binary_cross_entropy_with_logits, silu
except ImportError as error:
    raise ImportError("the study needs PyTorch: apt-get install python3-torch") from error

from loss_samples import learning_rate, standard_scale, unit_scale

HIDDEN_LAYERS, NEURONS, BATCH = 7, 21, 32
LOSSES = {  # of the last layer's values and the targets, by value
    "squared error": lambda last, target: (last - target) ** 2,
    "cross-entropy": lambda last, target: binary_cross_entropy_with_logits(
        last, target, reduction="none"
    ),
    "squared error of the sigmoid": lambda last, target: (torch.sigmoid(last) - target) ** 2,
}
SCALES = {name: standard_scale if name == "squared error" else unit_scale for name in LOSSES}


def start(widths, seed):
    """Weights and biases of one network, as PyTorch's own layers start."""
    torch.manual_seed(seed)
    layers = [torch.nn.Linear(wide, narrow) for wide, narrow in zip(widths, widths[1:])]
    return [tensor for layer in layers for tensor in (layer.weight.T, layer.bias[None])]


def forward(parameters, signal):
    """Last layers' values [networks x rows x outputs]."""
    for number in range(0, len(parameters), 2):
        signal = torch.baddbmm(parameters[number + 1], signal, parameters[number])
        if number + 2 < len(parameters):
            signal = silu(signal)
    return signal


class Adam:
    """Adam with one learning rate [networks x 1 x 1] a network."""

    def __init__(self, parameters, rates):
        self.parameters, self.rates, self.steps = parameters, rates, 0
        self.means = [torch.zeros_like(one) for one in parameters]
        self.squares = [torch.zeros_like(one) for one in parameters]

    @torch.no_grad()
    def step(self, progress):
        self.steps += 1
        rates = self.rates * learning_rate(progress)
        first, second = 1 - 0.9**self.steps, 1 - 0.999**self.steps
        for one, mean, square in zip(self.parameters, self.means, self.squares):
            mean.lerp_(one.grad, 0.1)
            square.mul_(0.999).addcmul_(one.grad, one.grad, value=0.001)
            one.sub_(rates * (mean / first) / ((square / second).sqrt() + 1e-8))
            one.grad = None


def train(samples, networks, epochs):
    """Sizes [networks x held-out rows x outputs] that trained networks answer. `networks`: a list
    of (loss, learning rate, seed), all of a loss next to each other."""
    torch.set_num_threads(1)
    learnt = ~samples.held_out
    inputs = torch.tensor(samples.inputs[learnt], dtype=torch.float32)
    losses = list(dict.fromkeys(loss for loss, _, _ in networks))
    scales = {loss: SCALES[loss](samples.sizes[learnt]) for loss in losses}
    targets = {
        loss: torch.tensor((samples.sizes[learnt] - shift) / scale, dtype=torch.float32)
        for loss, (shift, scale) in scales.items()
    }
    rows = {loss: [i for i, one in enumerate(networks) if one[0] == loss] for loss in losses}
    widths = [inputs.shape[1], *[NEURONS] * HIDDEN_LAYERS, samples.sizes.shape[1]]
    started = zip(*(start(widths, seed) for _, _, seed in networks))
    parameters = [torch.stack(list(same)).detach().requires_grad_() for same in started]
    rates = torch.tensor([rate for _, rate, _ in networks])[:, None, None]
    adam = Adam(parameters, rates)
    seeds = [seed for _, _, seed in networks]
    streams = {seed: np.random.default_rng(seed) for seed in set(seeds)}
    count = len(inputs)
    batches = -(-count // BATCH)
    for epoch in range(epochs):
        orders = {seed: stream.permutation(count) for seed, stream in streams.items()}
        order = torch.tensor(np.array([orders[seed] for seed in seeds]))
        for batch in range(batches):
            seen = order[:, batch * count // batches : (batch + 1) * count // batches]
            last = forward(parameters, inputs[seen])
            loss = sum(
                LOSSES[name](last[mine], targets[name][seen[mine]]).mean(dim=(1, 2)).sum()
                for name, mine in rows.items()
            )
            loss.backward()
            adam.step((epoch + (batch + 1) / batches) / epochs)
    asked = torch.tensor(samples.inputs[samples.held_out], dtype=torch.float32)
    with torch.no_grad():
        last = forward(parameters, asked.expand(len(networks), -1, -1))
    answers = []
    for (loss, _, _), value in zip(networks, last):
        shift, scale = scales[loss]
        value = value if loss == "squared error" else torch.sigmoid(value)
        answers.append(value.double().numpy() * scale + shift)
    return np.array(answers)
