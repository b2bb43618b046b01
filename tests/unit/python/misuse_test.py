# SPDX-License-Identifier: BSD-3-Clause
"""Misuses: each raises one clear line that names what came or what to do, and nothing crashes."""

import pathlib
import tempfile
import unittest
from typing import Any, Callable

import edgevo
import numpy as np
import scene

CAMERA = ("radtan", 640, 480, 500.0, 500.0, 320.0, 240.0)


def odometry(**options: Any) -> edgevo.Odometry:
    return edgevo.Odometry(scene.camera(), **options)


def process(image: Any, time: Any = 0.0) -> Any:
    return odometry().process(image, time)


def gray() -> np.ndarray:
    return scene.frames()[0].image.copy()


def after(first: Any, second: Any) -> Any:
    run = odometry()
    run.process(gray(), first)
    return run.process(gray(), second)


def finished() -> edgevo.Odometry:
    run = odometry()
    run.process(gray(), 0.0)
    run.finish()
    return run


def user_source(item: Any) -> Any:
    class Mine(edgevo.Source):
        def __next__(self) -> Any:
            return item

    return edgevo.run(Mine(scene.camera()))


class NoNext(edgevo.Source):
    pass


class NoInit(edgevo.Source):
    def __init__(self) -> None:
        pass


class NoCamera(edgevo.Source):
    def __next__(self) -> Any:
        raise StopIteration


class Empty(NoCamera):
    def __init__(self) -> None:
        super().__init__(scene.camera())


def camera(**changed: Any) -> Any:
    names = ("model", "width", "height", "fx", "fy", "cx", "cy")
    return edgevo.Camera(**{**dict(zip(names, CAMERA)), **changed})


def the_map() -> edgevo.Map:
    return edgevo.Map(scene.run())


def set_read_only(target: Any, name: str) -> None:
    setattr(target, name, None)


def read_twice() -> Any:
    source = scene.source((0, 2))
    list(source)
    return edgevo.run(source)


def frame_with_time() -> Any:
    return process(scene.frames()[0], 1.0)


def both_kinds() -> Any:
    run = odometry()
    run.process(gray(), 0.0)
    return run.process(gray().astype(np.uint16), 1.0)


def set_camera_of_opened() -> None:
    scene.source().camera = scene.camera()


Misuse = tuple[Callable[[str], Any], type[BaseException], str]
E, T = edgevo.InputError, TypeError

MISUSES: dict[str, Misuse] = {
    # Images
    "a list as image": (lambda f: process([[1, 2], [3, 4]]), T, "image is list; an array of uint8, 240 x 320"),
    "no image": (lambda f: process(None), T, "image is None"),
    "a path as image": (lambda f: process("a.png"), T, "image is str 'a.png'"),
    "float64": (lambda f: process(gray() / 255.0), T, "image is an array of float64, 240 x 320"),
    "float32": (lambda f: process(gray().astype(np.float32)), T, "an array of float32"),
    "int64": (lambda f: process(gray().astype(np.int64)), T, "an array of int64"),
    "int8": (lambda f: process(gray().astype(np.int8)), T, "an array of int8"),
    "bool": (lambda f: process(gray() > 9), T, "an array of bool"),
    "objects": (lambda f: process(gray().astype(object)), T, "an array of object"),
    "uint16 of the other byte order": (lambda f: process(gray().astype(">u2")), T, "an array of >u2"),
    "another size": (lambda f: process(gray()[:-1]), E, "239 x 320; an array of uint8, 240 x 320"),
    "transposed": (lambda f: process(gray().T), E, "320 x 240"),
    "one axis": (lambda f: process(gray().ravel()), E, "76800"),
    "four channels": (lambda f: process(np.dstack([gray()] * 4)), E, "240 x 320 x 4"),
    "channels first": (lambda f: process(np.stack([gray()] * 3)), E, "3 x 240 x 320"),
    "an empty array": (lambda f: process(np.empty((0, 0), np.uint8)), E, "0 x 0"),
    "every second column": (lambda f: process(np.repeat(gray(), 2, 1)[:, ::2]), E, "numpy.ascontiguousarray(image)"),
    "mirrored": (lambda f: process(gray()[:, ::-1]), E, "numpy.ascontiguousarray(image)"),
    "columns in Fortran's order": (lambda f: process(np.asfortranarray(gray())), E, "ascontiguousarray"),
    "colour, red first, as a view": (lambda f: process(np.dstack([gray()] * 3)[..., ::-1]), E, "ascontiguousarray"),
    "8 bits, then 16": (lambda f: both_kinds(), E, "the images before it were uint8 H x W"),
    # Times
    "a text as rate": (lambda f: odometry().add_gyro(0.0, "fast"), T, "rate is str 'fast'; numbers, 3 or N x 3"),
    "two samples at once": (lambda f: odometry().add_gyro(0.0, np.zeros((2, 3))), E, "three numbers in rad/s"),
    "a rate that is NaN": (lambda f: odometry().add_gyro(0.0, (0, 0, np.nan)), E, "holds NaN or infinity"),
    "no time": (lambda f: odometry().process(gray()), T, "time is missing; wanted process(image, time)"),
    "a text as time": (lambda f: process(gray(), "0.1"), T, "time is str '0.1'; seconds (float) or nanoseconds (int)"),
    "an array as time": (lambda f: process(gray(), np.array([0.1])), T, "time is an array of float64, 1"),
    "True as time": (lambda f: process(gray(), True), T, "time is bool True"),
    "float32 as time": (lambda f: process(gray(), np.float32(1)), T, "time is numpy.float32"),
    "NaN as time": (lambda f: process(gray(), float("nan")), E, "time is nan seconds"),
    "infinity as time": (lambda f: process(gray(), float("inf")), E, "time is inf seconds"),
    "too many nanoseconds": (lambda f: process(gray(), 2**70), E, "64 bits"),
    "nanoseconds as float": (lambda f: process(gray(), 1.7e18), E, "time is 1.7e+18 seconds"),
    "the same time again": (lambda f: after(1.0, 1.0), E, "not after 1.0000000 s, that of the frame before"),
    "back in time": (lambda f: after(2.0, 1.0), E, "give images in the order of their times"),
    "a counter as time": (lambda f: after(0, 1), E, "in nanoseconds, next to 0.0000000 s"),
    "a Frame with a time": (lambda f: frame_with_time(), T, "has its own; omit it"),
    "one argument too many": (lambda f: odometry().process(gray(), 1.0, 2), T, "3 arguments came without a name"),
    # Odometry
    "no camera": (lambda f: edgevo.Odometry(), T, "'camera' is missing"),
    "a path as camera": (lambda f: edgevo.Odometry("camera.yaml"), T, "camera is str 'camera.yaml'; a Camera is wanted"),
    "an unknown argument": (lambda f: odometry(detector="canny"), T, "there is no argument 'detector'"),
    "a negative seed": (lambda f: odometry(seed=-1), E, "from 0 to 2**64 - 1"),
    "a float as seed": (lambda f: odometry(seed=1.5), T, "seed is float 1.5; an int is wanted"),
    "a text as flag": (lambda f: odometry(realtime="yes"), T, "realtime is str 'yes'; True or False"),
    "a log that cannot be called": (lambda f: odometry(log=1), T, "log is int 1; a function is wanted"),
    "process() after finish()": (lambda f: finished().process(gray(), 1.0), RuntimeError, "finish() has ended the run"),
    "finish() twice": (lambda f: finished().finish(), RuntimeError, "finish() has ended the run"),
    # Parameters
    "a list as params": (lambda f: odometry(params=["edges"]), T, "params is list; a dict of names and values"),
    "a number as name": (lambda f: odometry(params={1: 2}), T, "names of parameters are str"),
    "an unknown parameter": (lambda f: odometry(params={"edges.detectr": "canny"}), E, "did you mean 'edges.detector'?"),
    "out of range": (lambda f: odometry(params={"edges": {"canny_percentile": 7}}), E, "out of range; it must be between"),
    "a value of another type": (lambda f: odometry(params={"health.corners": 3.5}), E, "is neither true nor false"),
    "a list as value": (lambda f: odometry(params={"health.corners": [1]}), T, "params[health.corners] is list"),
    "a group as value": (lambda f: odometry(params={"health": True}), E, "is a group of parameters"),
    "an equals sign in a name": (lambda f: odometry(params={"a=b": 1}), E, "edgevo.params() lists them"),
    # Cameras
    "an unknown model": (lambda f: camera(model="radtn"), E, "Camera(): distortion_model 'radtn'"),
    "coefficients of a pinhole": (lambda f: camera(model="pinhole", d=[0.1]), E, "a pinhole has none"),
    "too few coefficients": (lambda f: camera(d=[0.1, 0.2, 0.3]), E, "has 3 coefficients"),
    "a text as coefficients": (lambda f: camera(d="k1"), T, "d is str 'k1'; a list of numbers"),
    "no width": (lambda f: camera(width=0), E, "width is 0; give a number from 1"),
    "a focal length that is negative": (lambda f: camera(fx=-5), E, "focal lengths must be positive"),
    "a focal length that is NaN": (lambda f: camera(fx=float("nan")), E, "fx is nan; give a finite number"),
    "a camera file that is not there": (lambda f: edgevo.read_camera(f + "/none.yaml"), E, "none.yaml"),
    "a folder as camera file": (lambda f: edgevo.read_camera(f), E, f"{tempfile.gettempdir()}"),
    "a number as path": (lambda f: edgevo.read_camera(3), T, "path is int 3; a path (str or os.PathLike)"),
    "an empty path": (lambda f: edgevo.read_camera(""), E, "is an empty path"),
    "a null character in a path": (lambda f: edgevo.read_camera("a\0b"), E, "null character"),
    # Sources
    "a source that is not there": (lambda f: edgevo.open_source(f + "/none"), E, "no such file or folder"),
    "an empty folder": (lambda f: edgevo.open_source(f), E, f"{tempfile.gettempdir()}"),
    "frames that end before they begin": (lambda f: edgevo.simulate("desk", frames=(5, 2)), E, "ends at 2 before"),
    "frames as a number": (lambda f: edgevo.simulate("desk", frames=5), T, "frames is int 5; (first, end)"),
    "frames beyond the end": (lambda f: edgevo.simulate("desk", frames=(0, 10**6)), E, "frames"),
    "an unknown scene": (lambda f: edgevo.simulate("strete"), E, "street"),
    "a source without __next__": (lambda f: edgevo.run(NoNext(scene.camera())), NotImplementedError, "return (image, time)"),
    "a source without __init__": (lambda f: edgevo.run(NoInit()), T, "__init__() must be called"),
    "a source without camera": (lambda f: edgevo.run(NoCamera()), AttributeError, "super().__init__(camera)"),
    "a source without frames": (lambda f: edgevo.run(Empty()), E, "has no frames"),
    "a source read twice": (lambda f: read_twice(), E, "a Source can be read once"),
    "a source that returns an image only": (lambda f: user_source(gray()), T, "(image, time) or a Frame is wanted"),
    "a source that returns None": (lambda f: user_source(None), T, "Source.__next__() returned None"),
    "a source with images of another size": (lambda f: user_source((gray()[:-1], 0.0)), E, "239 x 320"),
    "a list as source": (lambda f: edgevo.run([1]), T, "source is list; a path"),
    "an iterator as source": (lambda f: edgevo.run(iter([])), T, "a path or a Source"),
    "the camera of an open source set": (lambda f: set_camera_of_opened(), AttributeError, "cannot be set"),
    # Runs
    "an unknown scale": (lambda f: edgevo.run(scene.source(), scale="gsp"), E, "gps"),
    "a run by its class": (lambda f: edgevo.Run(), T, "No constructor defined"),
    "a folder that holds no run": (lambda f: edgevo.load_run(f), E, "cannot be read"),
    "a run that is not there": (lambda f: edgevo.load_run(f + "/none"), E, "is not a folder"),
    "a file where the folder of a run is to be": (lambda f: scene.run().save(__file__), E, "misuse_test.py"),
    "a trajectory into a folder that is not there": (lambda f: scene.run().to_tum(f + "/no/a.txt"), E, "no/a.txt"),
    "a negative sigma": (lambda f: scene.run().points(sigma_max=-1), E, "sigma_max is int -1"),
    "an attribute that is read-only": (lambda f: set_read_only(scene.run(), "poses"), AttributeError, ""),
    # Evaluation
    "a path as run": (lambda f: edgevo.evaluate("out", "truth.txt"), T, "run is str 'out'; a Run is wanted"),
    "a number as truth": (lambda f: edgevo.evaluate(scene.run(), 3), T, "a path, a Source or (times, poses)"),
    "a truth that is not there": (lambda f: edgevo.evaluate(scene.run(), f + "/none.txt"), E, "none.txt"),
    "a truth that is no trajectory": (lambda f: edgevo.evaluate(scene.run(), __file__), E, "misuse_test.py"),
    "a truth of another time": (
        lambda f: edgevo.evaluate(scene.run(), (scene.run().times + 1e6, scene.run().poses)), E, ""),
    "poses of another shape": (
        lambda f: edgevo.evaluate(scene.run(), (scene.run().times, scene.run().poses[:, :3])), T, "poses (N, 4, 4)"),
    "poses that are no motions": (
        lambda f: edgevo.evaluate(scene.run(), (np.arange(9.0), np.ones((9, 4, 4)))), E, "no rigid motion"),
    # Maps
    "a map of a path": (lambda f: edgevo.Map("out"), T, "run is str 'out'; a Run is wanted"),
    "a point of two numbers": (lambda f: the_map().occupied([1, 2]), E, "give 3 or N x 3 numbers"),
    "points as columns": (lambda f: the_map().distance(np.zeros((3, 5))), E, "an array of float64, 3 x 5"),
    "a text as point": (lambda f: the_map().occupied("abc"), T, "xyz is str 'abc'"),
    "a point that is NaN": (lambda f: the_map().distance([np.nan, 0, 0]), E, "NaN"),
    "voxels that are nothing": (lambda f: edgevo.Map(scene.run(), {"occupancy.resolution": "-1"}), E, "resolution"),
    "voxels that are too small": (lambda f: edgevo.Map(scene.run(), {"occupancy.resolution": "1e-9"}), E, "resolution"),
}


class Misuses(unittest.TestCase):
    def test_each_is_one_clear_line(self) -> None:
        self.assertGreaterEqual(len(MISUSES), 60)
        for name, (call, expected, words) in MISUSES.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                with self.assertRaises(expected) as caught:
                    call(folder)
                message = str(caught.exception)
                self.assertEqual(len(message.splitlines()), 1, message)
                self.assertIn(words, message)
                self.assertLess(len(message), 400, message)
                self.assertFalse(list(pathlib.Path(folder).iterdir()), "something was left in the folder")

    def test_after_a_misuse_the_run_goes_on(self) -> None:
        run = odometry()
        for frame in scene.frames():
            for wrong in (None, frame.image[1:], frame.image[:, ::-1]):
                with self.assertRaises((TypeError, ValueError)):
                    run.process(wrong, frame.time_ns)
            run.process(frame.image, frame.time_ns)
        self.assertTrue(np.array_equal(run.finish().poses, scene.run().poses, equal_nan=True))


if __name__ == "__main__":
    unittest.main()
