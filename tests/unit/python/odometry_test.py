# SPDX-License-Identifier: BSD-3-Clause
import threading
import unittest

import edgevo
import numpy as np
import scene


def tum(run: edgevo.Run, path: str) -> bytes:
    run.to_tum(path)
    with open(path, "rb") as file:
        return file.read()


class Odometry(unittest.TestCase):
    def setUp(self) -> None:
        import tempfile
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def poses_of(self, run: edgevo.Run) -> bytes:
        return tum(run, f"{self.folder}/poses.txt")

    def test_every_way_in_gives_the_same_bytes(self) -> None:
        by_run = self.poses_of(scene.run())
        self.assertGreater(np.isfinite(scene.run().poses[:, 0, 0]).sum(), 20)
        frame_by_frame, by_array = edgevo.Odometry(scene.camera()), edgevo.Odometry(scene.camera())
        for frame in scene.frames():
            frame_by_frame.process(frame)
            by_array.process(frame.image, frame.time_ns)
        self.assertEqual(self.poses_of(frame_by_frame.finish()), by_run)
        self.assertEqual(self.poses_of(by_array.finish()), by_run)
        self.assertEqual(self.poses_of(edgevo.run(scene.Replay())), by_run)

    def test_the_image_may_be_overwritten_after_the_call(self) -> None:
        odometry, image = edgevo.Odometry(scene.camera()), np.empty_like(scene.frames()[0].image)
        for frame in scene.frames():
            image[:] = frame.image
            odometry.process(image, frame.time_ns)
            image[:] = 77
        self.assertEqual(self.poses_of(odometry.finish()), self.poses_of(scene.run()))

    def test_a_gyro_is_taken_by_calls_and_of_a_source(self) -> None:
        samples, params = scene.gyro(), {"camera.refine": "none"}
        odometry, waiting = edgevo.Odometry(scene.camera(), params), list(samples)
        self.assertEqual(odometry.gyro, "")
        for frame in scene.frames():
            while waiting and waiting[0][0] < frame.time + 0.3:
                odometry.add_gyro(*waiting.pop(0))
            odometry.process(frame)
        self.assertIn("not observed", odometry.gyro)  # in a second
        source = scene.Replay()
        source.gyro = samples  # type: ignore[attr-defined]
        self.assertEqual(self.poses_of(odometry.finish()), self.poses_of(edgevo.run(source, params)))

    def test_a_run_is_placed_in_an_earlier_map(self) -> None:
        scene.run().save(f"{self.folder}/earlier")
        T_world_odom, seen = [np.eye(4)], []

        def take(event: edgevo.Event) -> None:
            if event.kind == "placed" and event.T is not None:
                T_world_odom[0] = event.T
                seen.append(odometry.is_in_map)

        odometry = edgevo.Odometry(scene.camera(), map=f"{self.folder}/earlier", on_event=take)
        self.assertFalse(odometry.is_in_map)
        far = []
        for frame in scene.frames():
            record = odometry.process(frame)
            if odometry.is_in_map and record.T_world_cam is not None:
                here = T_world_odom[0] @ record.T_world_cam
                far.append(np.linalg.norm(here[:3, 3] - scene.run().poses[frame.index, :3, 3]))
        path = np.linalg.norm(np.diff(scene.run().poses[:, :3, 3], axis=0), axis=1)
        self.assertGreater(len(far), 10)
        self.assertLess(max(far), 0.1 * np.nansum(path))  # while the map is young
        self.assertTrue(seen and seen[-1])
        run = odometry.finish()
        self.assertTrue(run.is_in_map and odometry.is_in_map)
        self.assertFalse(scene.run().is_in_map)
        lines: list[str] = []
        again = edgevo.run(scene.Replay(), map=f"{self.folder}/earlier/map.db", log=lines.append)
        self.assertTrue(again.is_in_map)
        self.assertTrue(any("frames found in" in line for line in lines), lines)

    def test_maps_that_cannot_be_used_are_refused(self) -> None:
        for wrong in ({"map": f"{self.folder}/none"}, {"map": __file__}):
            with self.assertRaises(edgevo.InputError):
                edgevo.Odometry(scene.camera(), **wrong)
        scene.run().save(f"{self.folder}/earlier")
        with self.assertRaisesRegex(edgevo.InputError, "forget"):
            edgevo.Odometry(scene.camera(), map=f"{self.folder}/earlier", forget=True)

    def test_the_seed_counts(self) -> None:
        other = edgevo.run(scene.Replay(), seed=2)
        self.assertNotEqual(self.poses_of(other), self.poses_of(scene.run()))

    def test_colour_is_converted_and_said(self) -> None:
        lines: list[str] = []
        odometry = edgevo.Odometry(scene.camera(), log=lines.append)
        for frame in scene.frames()[:20]:
            odometry.process(np.repeat(frame.image[:, :, None], 3, axis=2), frame.time_ns)
        gray = edgevo.run(scene.Replay(20))
        self.assertEqual(self.poses_of(odometry.finish()), self.poses_of(gray))
        self.assertEqual(sum("converted to gray" in line for line in lines), 1)

    def test_sixteen_bits_are_scaled_and_said(self) -> None:
        lines: list[str] = []
        odometry = edgevo.Odometry(scene.camera(), log=lines.append)
        for frame in scene.frames()[:20]:
            odometry.process(frame.image.astype(np.uint16) * 16, frame.time_ns)
        self.assertGreater(np.isfinite(odometry.finish().poses[:, 0, 0]).sum(), 10)
        self.assertEqual(sum("intensities: 12 bits" in line for line in lines), 1, lines)

    def test_a_record_is_a_value(self) -> None:
        odometry = edgevo.Odometry(scene.camera())
        records = [odometry.process(frame) for frame in scene.frames()]
        run = odometry.finish()
        self.assertIs(records[0].state, edgevo.State.BOOTSTRAPPING)
        self.assertIsNone(records[0].T_world_cam)
        self.assertTrue(np.isnan(records[0].covariance).all())
        good = [r for r in records if r.ok]
        self.assertGreater(len(good), 10)
        for record in good:
            assert record.T_world_cam is not None
            self.assertEqual(record.T_world_cam.shape, (4, 4))
            self.assertEqual(record.covariance.shape, (6, 6))
            self.assertFalse(record.T_world_cam.flags.writeable)
        known = [r.covariance for r in good if np.isfinite(r.covariance).all()]
        self.assertGreater(len(known), 5)
        self.assertTrue(all((np.linalg.eigvalsh(covariance) > 0).all() for covariance in known))
        self.assertEqual([r.time_ns for r in records], list(run.times_ns))

    def test_events_say_what_happened(self) -> None:
        events: list[edgevo.Event] = []
        odometry = edgevo.Odometry(scene.camera(), on_event=events.append)
        for frame in scene.frames():
            odometry.process(frame)
        kinds = {event.kind for event in events}
        self.assertLessEqual({"state", "segment", "keyframe", "pose"}, kinds)
        found = [event for event in events if event.kind == "pose"]
        assert found[0].T is not None
        self.assertEqual(found[0].T.shape, (4, 4))

    def test_what_a_callback_raises_comes_out(self) -> None:
        def fail(*_: object) -> None:
            raise KeyError("of the callback")

        for callbacks in ({"on_event": fail}, {"log": fail}):
            odometry = edgevo.Odometry(scene.camera(), **callbacks)  # type: ignore[arg-type]
            with self.assertRaisesRegex(KeyError, "of the callback"):
                for frame in scene.frames():
                    odometry.process(np.repeat(frame.image[:, :, None], 3, axis=2), frame.time_ns)
        with self.assertRaisesRegex(KeyError, "of the callback"):
            edgevo.run(scene.Replay(), progress=fail)
        with self.assertRaisesRegex(KeyError, "of the callback"):
            edgevo.run(scene.source(), progress=lambda done, total: fail() if done == 5 else None)

    def test_an_exception_of_a_source_comes_out(self) -> None:
        class Fails(scene.Replay):
            def __next__(self) -> tuple[np.ndarray, int]:
                if len(self.waiting) < 20:
                    raise OSError("the cable is out")
                return super().__next__()

        with self.assertRaisesRegex(OSError, "the cable is out"):
            edgevo.run(Fails())

    def test_progress_counts_to_the_end(self) -> None:
        seen: list[tuple[int, object]] = []
        edgevo.run(scene.source((0, 6)), progress=lambda done, total: seen.append((done, total)))
        self.assertEqual(seen, [(i, 6) for i in range(1, 7)])

    def test_control_c_ends_a_run_between_frames(self) -> None:
        import os
        import signal
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            edgevo.run(edgevo.simulate("street"))

    def test_other_threads_run_meanwhile(self) -> None:
        counted: list[int] = []
        is_done = threading.Event()

        def count() -> None:
            n = 0
            while not is_done.is_set():
                n += 1
            counted.append(n)

        thread = threading.Thread(target=count)
        thread.start()
        edgevo.run(scene.source((0, 10)))
        is_done.set()
        thread.join()
        self.assertGreater(counted[0], 1000)

    def test_a_call_during_a_call_is_refused(self) -> None:
        said: list[str] = []

        def again(_: edgevo.Event) -> None:
            try:
                odometry.process(scene.frames()[1])
            except RuntimeError as error:
                said.append(str(error))

        odometry = edgevo.Odometry(scene.camera(), on_event=again)
        odometry.process(scene.frames()[0])
        self.assertEqual(said[:1], ["Odometry.process(): another call is in progress; make one call at a time"])

    def test_two_odometries_run_at_a_time(self) -> None:
        runs: list[edgevo.Run] = []
        threads = [threading.Thread(target=lambda: runs.append(edgevo.run(scene.Replay()))) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(self.poses_of(runs[0]), self.poses_of(scene.run()))
        self.assertEqual(self.poses_of(runs[1]), self.poses_of(scene.run()))

    def test_realtime_gives_poses_too(self) -> None:
        odometry = edgevo.Odometry(scene.camera(), realtime=True)
        for frame in scene.frames():
            odometry.process(frame)
        self.assertGreater(np.isfinite(odometry.finish().poses[:, 0, 0]).sum(), 10)

    def test_a_run_that_forgets_keeps_no_keyframes(self) -> None:
        odometry = edgevo.Odometry(scene.camera(), forget=True)
        records = [odometry.process(frame) for frame in scene.frames()]
        self.assertTrue(records[-1].ok)
        self.assertEqual(len(odometry.finish().keyframes), 0)

    def test_it_never_prints(self) -> None:
        import subprocess
        import sys
        code = ("import scene, edgevo\n"
                "o = edgevo.Odometry(scene.camera())\n"
                "[o.process(f) for f in scene.frames()]\n"
                "m = edgevo.Map(o.finish())\n"
                "m.distance([1e9, 0, 0]); m.occupied([1e9, 0, 0])\n")
        done = subprocess.run([sys.executable, "-c", code], cwd=scene.ROOT / "tests/unit/python", capture_output=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))


if __name__ == "__main__":
    unittest.main()
