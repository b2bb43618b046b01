# SPDX-License-Identifier: BSD-3-Clause
"""What the tests share: a rendered desk in small images, and one run on it."""

import functools
import os
import pathlib
import re

import edgevo
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
FRAMES = 30


@functools.lru_cache(maxsize=None)
def scene_file() -> str:
    """The desk at half the size, in a file of its own."""
    text = (ROOT / "datasets/scenes/desk.yaml").read_text()

    def halved(match: "re.Match[str]") -> str:
        value = float(match.group(2)) / 2
        return f"{match.group(1)}{int(value) if value.is_integer() else value}"

    text = re.sub(r"(?m)^(  (?:width|height|fx|fy|cx|cy): )([0-9.]+)", halved, text)
    path = pathlib.Path(os.environ.get("EDGEVO_TEST_FOLDER", "/tmp")) / f"small_desk_{os.getpid()}.yaml"
    path.write_text(text)
    import atexit
    atexit.register(path.unlink)
    return str(path)


def source(frames: tuple[int, int] = (0, FRAMES)) -> edgevo.Source:
    return edgevo.simulate(scene_file(), frames=frames)


@functools.lru_cache(maxsize=None)
def frames() -> tuple[edgevo.Frame, ...]:
    return tuple(source())


@functools.lru_cache(maxsize=None)
def camera() -> edgevo.Camera:
    return source().camera


@functools.lru_cache(maxsize=None)
def run() -> edgevo.Run:
    return edgevo.run(source())


class Replay(edgevo.Source):
    """The frames again, as arrays and times."""

    def __init__(self, count: int = FRAMES) -> None:
        super().__init__(camera())
        self.waiting = list(frames()[:count])

    def __next__(self) -> tuple[np.ndarray, int]:
        if not self.waiting:
            raise StopIteration
        frame = self.waiting.pop(0)
        return frame.image, frame.time_ns
