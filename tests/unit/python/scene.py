# SPDX-License-Identifier: BSD-3-Clause
"""What the tests share: a rendered desk in small images, and one run on it."""

import functools
import pathlib
import re
import tempfile
import unittest

import edgevo
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
FRAMES = 30


_folder = tempfile.TemporaryDirectory()


@functools.lru_cache(maxsize=None)
def small_scene(name: str) -> str:
    """A scene with images of half the size, as a file."""
    def halved(match: "re.Match[str]") -> str:
        half = float(match.group(2)) / 2
        return match.group(1) + (str(int(half)) if "." not in match.group(2) else str(half))

    text = (ROOT / f"datasets/scenes/{name}.yaml").read_text()
    path = pathlib.Path(_folder.name) / f"{name}.yaml"
    path.write_text(re.sub(r"(?m)^(  (?:width|height|fx|fy|cx|cy): )([0-9.]+)", halved, text))
    return str(path)


def source(frames: tuple[int, int] = (0, FRAMES)) -> edgevo.Source:
    return edgevo.simulate(small_scene("desk"), frames=frames)


@functools.lru_cache(maxsize=None)
def frames() -> tuple[edgevo.Frame, ...]:
    return tuple(source())


@functools.lru_cache(maxsize=None)
def camera() -> edgevo.Camera:
    return source().camera


@functools.lru_cache(maxsize=None)
def run() -> edgevo.Run:
    return edgevo.run(source())


@functools.lru_cache(maxsize=None)
def gyro() -> list[tuple[float, np.ndarray]]:
    """What a gyro in the axes of the camera measures on the way of run(): times and rates."""
    poses, times = run().poses, run().times
    samples = []
    for k in range(1, len(times)):
        turn = poses[k - 1, :3, :3].T @ poses[k, :3, :3]
        rate = np.array([turn[2, 1], turn[0, 2], turn[1, 0]]) / (times[k] - times[k - 1])
        if np.isfinite(rate).all():
            steps = np.linspace(times[k - 1], times[k], 4)[1:]
            samples += [(float(t), rate) for t in steps]
    return samples


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


def write_folder(source: edgevo.Source, folder: str) -> None:
    """Images, times and camera in the layout of edgevo, and camera.yaml."""
    try:
        import cv2
    except ImportError:
        raise unittest.SkipTest("SKIPPED: python3-opencv is not installed")
    images = pathlib.Path(folder) / "images"
    images.mkdir()
    times = []
    for frame in source:
        cv2.imwrite(f"{images}/{frame.index:06d}.png", frame.image)
        times.append(f"{frame.time:.7f}\n")
    (pathlib.Path(folder) / "times.txt").write_text("".join(times))
    camera = source.camera
    camera.save(f"{folder}/camera.yaml")
    K, d = camera.K, camera.d or (0.0,) * 5
    numbers = [K[0, 0], K[1, 1], K[0, 2], K[1, 2], *d[:4], camera.width, camera.height, d[4]]
    (pathlib.Path(folder) / "camera.txt").write_text(" ".join(f"{number:.17g}" for number in numbers) + "\n")
