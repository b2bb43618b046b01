# SPDX-License-Identifier: BSD-3-Clause
"""The edge network: small enough to process every frame of a live camera on one core.

Gray image in, edge probability out, of the same size (sides are multiples of 4). A stem at half size, context at a quarter by
depthwise convolutions of increasing dilation, and back by transposed convolutions. OpenCV 4.6 supports all its layers.
"""
import torch
from torch import nn


class Around(nn.Module):
    """A residual block: depthwise convolution with a dilation of `reach` pixels, then a mix of the channels."""

    def __init__(self, channels, reach):
        super().__init__()
        self.look = nn.Conv2d(channels, channels, 3, padding=reach, dilation=reach, groups=channels)
        self.mix = nn.Conv2d(channels, channels, 1)

    def forward(self, x):
        return x + torch.relu(self.mix(torch.relu(self.look(x))))


class EdgeNetwork(nn.Module):
    def __init__(self, half=12, quarter=32, reaches=(1, 2, 4, 1)):
        super().__init__()
        self.stem = nn.Conv2d(1, half, 5, stride=2, padding=2)
        self.near = Around(half, 1)
        self.down = nn.Conv2d(half, quarter, 3, stride=2, padding=1)
        self.context = nn.Sequential(*[Around(quarter, reach) for reach in reaches])
        self.up = nn.ConvTranspose2d(quarter, half, 2, stride=2)
        self.join = Around(half, 1)
        self.out = nn.ConvTranspose2d(half, 1, 4, stride=2, padding=1)

    def logits(self, gray):
        fine = self.near(torch.relu(self.stem(gray)))
        coarse = self.context(torch.relu(self.down(fine)))
        return self.out(self.join(fine + torch.relu(self.up(coarse))))

    def forward(self, gray):
        return torch.sigmoid(self.logits(gray))
