#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Trains the edge network on the pieces that edgevo_training_set writes, and exports it for OpenCV's dnn.

    train_network.py TRAINING_SET OUT.onnx [--seed N] [--epochs N]

Debian: python3-torch, python3-onnx. One thread, so that the same seed gives the same file.
"""
import argparse
import random
import time

import numpy
import torch

from network import EdgeNetwork

# (pixel - MEAN) / STD of gray levels 0 to 1: the same numbers as in edge_network.yaml.
MEAN, STD = 0.5, 0.25
# Weight of a missed edge pixel relative to a false one: edges are only about 8 % of all pixels.
MISSED = 2.0


def read_samples(path):
    """Images and labels, count x height x width, uint8."""
    with open(path, "rb") as file:
        if file.readline() != b"edgevo training set 1\n":
            raise SystemExit(f"{path}: is not a training set; make one with edgevo_training_set")
        count, width, height = map(int, file.readline().split())
        data = numpy.frombuffer(file.read(), numpy.uint8).reshape(count, 2, height, width)
    return data[:, 0], data[:, 1]


def as_batch(images, labels, order):
    gray = torch.from_numpy(images[order].astype(numpy.float32) / 255.0)
    edge = torch.from_numpy((labels[order] > 0).astype(numpy.float32))
    return gray[:, None], edge[:, None]


def varied(gray, edge, draw):
    """Augmentation: mirrored, upside down, and with other contrast, beyond what `relight` changes."""
    if draw.random() < 0.5:
        gray, edge = gray.flip(3), edge.flip(3)
    if draw.random() < 0.25:
        gray, edge = gray.flip(2), edge.flip(2)
    gain, bias = numpy.exp(draw.uniform(-0.7, 0.4)), draw.uniform(-0.1, 0.1)
    return (gray * gain + bias).clamp(0, 1), edge


def loss_of(network, gray, edge):
    logits = network.logits((gray - MEAN) / STD)
    return torch.nn.functional.binary_cross_entropy_with_logits(logits, edge, pos_weight=torch.tensor(MISSED))


def train(network, images, labels, epochs, seed, batch=4):
    draw = random.Random(seed)
    steps = epochs * (len(images) // batch)
    optimiser = torch.optim.Adam(network.parameters(), lr=4e-3)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, max_lr=6e-3, total_steps=steps + 1)
    began = time.process_time()
    for epoch in range(epochs):
        order = list(range(len(images)))
        draw.shuffle(order)
        total = 0.0
        for i in range(0, len(order) - batch + 1, batch):
            gray, edge = varied(*as_batch(images, labels, order[i:i + batch]), draw)
            loss = loss_of(network, gray, edge)
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
            schedule.step()
            total += loss.item()
        print(f"epoch {epoch + 1} of {epochs}: loss {total / (len(order) // batch):.4f}, {time.process_time() - began:.0f} CPU s", flush=True)


def export(network, path):
    network.eval()
    any_size = {"gray": {2: "height", 3: "width"}, "edges": {2: "height", 3: "width"}}
    torch.onnx.export(network, torch.zeros(1, 1, 376, 1248), path, opset_version=11, input_names=["gray"], output_names=["edges"], dynamic_axes=any_size)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("training_set")
    parser.add_argument("out")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--epochs", type=int, default=10)
    options = parser.parse_args()
    torch.set_num_threads(1)
    torch.manual_seed(options.seed)
    torch.use_deterministic_algorithms(True)
    network = EdgeNetwork()
    images, labels = read_samples(options.training_set)
    print(f"{len(images)} pieces, {(labels > 0).mean():.3f} of the pixels are edges, {sum(p.numel() for p in network.parameters())} weights")
    train(network, images, labels, options.epochs, options.seed)
    export(network, options.out)


if __name__ == "__main__":
    main()
