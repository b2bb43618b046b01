# SPDX-License-Identifier: BSD-3-Clause
import pathlib
import sys
import tempfile
import types
import unittest
from unittest import mock

import edgevo
import numpy as np
import scene


class Results(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_arrays_have_a_row_for_each_frame_and_are_read_only(self) -> None:
        run, n = scene.run(), scene.FRAMES
        arrays = {"times": (n,), "times_ns": (n,), "poses": (n, 4, 4), "states": (n,), "segments": (n,)}
        for name, shape in arrays.items():
            array = getattr(run, name)
            self.assertEqual(array.shape, shape)
            self.assertFalse(array.flags.writeable)
            with self.assertRaises(ValueError):
                array[0] = 0
        self.assertTrue((run.states == edgevo.State.TRACKING).any())
        self.assertEqual(len(run), n)

    def test_arrays_outlive_their_run(self) -> None:
        run = edgevo.run(scene.Replay(10))
        poses, frame = run.poses, next(scene.source())
        image = frame.image
        del run, frame
        self.assertEqual(poses.shape, (10, 4, 4))
        self.assertEqual(image.sum(), scene.frames()[0].image.sum())

    def test_points_are_fewer_when_they_must_be_certain(self) -> None:
        run = scene.run()
        self.assertEqual(run.points().shape[1], 3)
        self.assertLess(len(run.points(sigma_max=0.02)), len(run.points()))
        self.assertEqual(sum(len(k.points) for k in run.keyframes), len(run.points()))
        self.assertTrue(all(line.ndim == 2 and line.shape[1] == 3 for line in run.lines()))

    def test_a_saved_run_is_that_of_the_program_and_is_read_back(self) -> None:
        run = scene.run()
        run.save(self.folder / "out")
        for name in ("trajectory_tum.txt", "trajectory_kitti.txt", "frames.csv", "edges.ply", "edges.bt", "grid.yaml",
                     "run.mcap", "report.html", "summary.yaml"):
            self.assertTrue((self.folder / "out" / name).is_file(), name)
        self.assertFalse((self.folder / "out/unfinished_run.bin").exists())
        run.to_tum(self.folder / "poses.txt")
        self.assertEqual((self.folder / "poses.txt").read_bytes(), (self.folder / "out/trajectory_tum.txt").read_bytes())
        loaded = edgevo.load_run(self.folder / "out")
        np.testing.assert_array_equal(loaded.times_ns, run.times_ns)
        np.testing.assert_array_equal(loaded.states, run.states)
        np.testing.assert_array_equal(loaded.segments, run.segments)
        np.testing.assert_allclose(loaded.poses, run.poses, atol=1e-6)
        self.assertEqual(len(loaded.keyframes), len(run.keyframes))
        self.assertEqual(len(loaded.points()), len(run.points()))

    def test_errors_are_those_of_the_truth(self) -> None:
        source = scene.source()
        run = edgevo.run(source)
        found = edgevo.evaluate(run, source)
        self.assertLess(found.ate, 0.02)
        self.assertGreater(found.matched, 20)
        self.assertIn("ATE", found.table())
        # The truth as arrays: the run itself, in metres and turned.
        good = np.isfinite(run.poses[:, 0, 0])
        truth = run.poses.copy()
        truth[:, :3, 3] *= 2
        by_arrays = edgevo.evaluate(run, (run.times, truth))
        self.assertLess(by_arrays.ate, 1e-6)
        self.assertAlmostEqual(by_arrays.scale, 2, places=6)
        self.assertEqual(by_arrays.matched, good.sum())

    def test_evo_gets_what_it_expects(self) -> None:
        module = types.ModuleType("evo.core.trajectory")
        module.PoseTrajectory3D = lambda **arguments: arguments  # type: ignore[attr-defined]
        fake = {"evo": types.ModuleType("evo"), "evo.core": types.ModuleType("evo.core"), "evo.core.trajectory": module}
        with mock.patch.dict(sys.modules, fake):
            given = scene.run().to_evo()
        poses = scene.run().poses[np.isfinite(scene.run().poses[:, 0, 0])]
        np.testing.assert_array_equal(given["positions_xyz"], poses[:, :3, 3])
        w, x, y, z = given["orientations_quat_wxyz"].T
        np.testing.assert_allclose(1 - 2 * (y * y + z * z), poses[:, 0, 0], atol=1e-9)
        np.testing.assert_allclose(2 * (x * y + z * w), poses[:, 1, 0], atol=1e-9)
        self.assertTrue(given["timestamps"].flags.writeable)

    def test_without_evo_the_remedy_is_named(self) -> None:
        with mock.patch.dict(sys.modules, {"evo": None}):
            with self.assertRaisesRegex(ImportError, "pip install evo"):
                scene.run().to_evo()

    def test_params_have_defaults_of_their_types(self) -> None:
        params = edgevo.params()
        self.assertEqual(params["edges.detector"].value, "canny")
        self.assertIs(type(params["recovery.max_frames"].value), int)
        self.assertIs(type(params["health.corners"].value), bool)
        self.assertTrue(all(p.meaning for p in params.values()))
        self.assertTrue(any(p.basic for p in params.values()))
        edgevo.Odometry(scene.camera(), {name: p.value for name, p in params.items()})
        edgevo.Odometry(scene.camera(), {"recovery": {"max_frames": np.int64(7)}, "health.corners": np.bool_(False)})

    def test_a_parameter_counts(self) -> None:
        few = edgevo.run(scene.Replay(), params={"edges": {"canny_percentile": 0.8}})
        self.assertFalse(np.array_equal(few.poses, scene.run().poses, equal_nan=True))


class Cameras(unittest.TestCase):
    def test_a_camera_is_written_and_read(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            for model, d in (("pinhole", ()), ("radtan", (0.1, -0.2, 0.001, 0.002, 0.05)), ("rational", (0.1,) * 8),
                             ("equidistant", (0.1, 0.01, 0, 0)), ("fov", (0.9,)), ("eucm", (0.5, 1.1)),
                             ("double_sphere", (-0.2, 0.6)), ("omni", (1.0, 0, 0, 0, 0))):
                camera = edgevo.Camera(model, 640, 480, 500, 501.5, 320, 240, d=d)
                camera.save(f"{folder}/camera.yaml")
                again = edgevo.read_camera(f"{folder}/camera.yaml")
                self.assertEqual((again.model, again.width, again.height), (camera.model, 640, 480))
                np.testing.assert_allclose(again.K, camera.K)
                np.testing.assert_allclose(again.d, camera.d)
        self.assertEqual(edgevo.Camera("pinhole", 640, 480, 500, 501.5, 320, 240).d, ())

    def test_the_matrix_is_that_of_the_pinhole(self) -> None:
        K = edgevo.Camera("pinhole", 640, 480, 500, 501.5, 320, 240).K
        np.testing.assert_array_equal(K, [[500, 0, 320], [0, 501.5, 240], [0, 0, 1]])


class Maps(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.map = edgevo.Map(scene.run())
        T = scene.run().T_map_world
        cls.points = scene.run().points() @ T[:3, :3].T + T[:3, 3]

    def test_edges_are_occupied(self) -> None:
        self.assertGreater(self.map.occupied(self.points).mean(), 0.5)
        one = self.points[self.map.occupied(self.points)][0]
        self.assertIs(self.map.occupied(list(one)), True)
        self.assertIs(self.map.free(list(one)), False)
        self.assertEqual(self.map.distance(list(one)), 0)

    def test_distances_are_those_of_a_search_of_all_voxels(self) -> None:
        run = scene.run()
        centres = (np.floor(self.points[self.map.occupied(self.points)] / self.map.voxel) + 0.5) * self.map.voxel
        centres = np.unique(centres.round(6), axis=0)
        where = np.random.default_rng(1).uniform(self.points.min(axis=0) - 3, self.points.max(axis=0) + 3, (50, 3))
        outside = np.abs(where[:, None] - centres[None]) - self.map.voxel / 2
        expected = np.linalg.norm(np.maximum(outside, 0), axis=2).min(axis=1)
        found = self.map.distance(where)
        # Lines occupy voxels, too.
        self.assertTrue((found <= expected + 1e-5).all())
        self.assertLess(np.median(expected - found), 2 * self.map.voxel)
        self.assertGreater(len(run.keyframes), 0)

    def test_far_away_nothing_is_known(self) -> None:
        for point in ([1e9, 0, 0], [-1e5, 1e5, 0]):
            self.assertFalse(self.map.occupied(point))
            self.assertFalse(self.map.free(point))
            self.assertGreater(self.map.distance(point), 1e4)

    def test_the_grid_has_its_place(self) -> None:
        grid = self.map.grid
        self.assertEqual(grid.dtype, np.int8)
        self.assertLessEqual(set(np.unique(grid)), {-1, 0, 100})
        self.assertGreater(self.map.resolution, 0)
        self.assertEqual(len(self.map.origin), 2)

    def test_the_resolution_is_a_parameter(self) -> None:
        finer = edgevo.Map(scene.run(), params={"occupancy.resolution": "0.05"})
        self.assertAlmostEqual(finer.voxel, 0.05)

    def test_a_run_without_points_has_an_empty_map(self) -> None:
        odometry = edgevo.Odometry(scene.camera())
        odometry.process(scene.frames()[0])
        empty = edgevo.Map(odometry.finish())
        self.assertEqual(empty.distance([0, 0, 0]), np.inf)
        self.assertFalse(empty.occupied([0, 0, 0]))


if __name__ == "__main__":
    unittest.main()
