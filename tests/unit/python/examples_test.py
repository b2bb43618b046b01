# SPDX-License-Identifier: BSD-3-Clause
"""The examples of share/examples/python and the pages, as a user runs them."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import edgevo
import numpy as np
import scene
import tutorial

EXAMPLES = scene.ROOT / "share/examples/python"


def start(program: pathlib.Path, *arguments: str, folder: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([sys.executable, str(program), *arguments], cwd=folder, capture_output=True, text=True)


class Examples(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_webcam(self) -> None:
        scene.write_folder(scene.source(), self.folder)
        done = start(EXAMPLES / "webcam.py", "camera.yaml", "images/%06d.png", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("TRACKING x=", done.stdout)
        self.assertIn("converted to gray", done.stdout)
        self.assertTrue(pathlib.Path(self.folder, "webcam_run/trajectory_tum.txt").is_file())

    def test_show_run(self) -> None:
        scene.write_folder(scene.source(), self.folder)
        done = start(EXAMPLES / "show_run.py", self.folder, "out", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        strict = scene.ROOT / "tests/unit/mcap_output/strict_mcap.py"
        checked = start(strict, "check", "out/run.mcap", folder=self.folder)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        self.assertRegex(checked.stdout, r"(?m)^ *[23][0-9] /edgevo/pose ")
        self.assertRegex(checked.stdout, r"(?m)^ *1 /edgevo/path ")

    def plan(self, *where: str) -> "subprocess.CompletedProcess[str]":
        return start(EXAMPLES / "plan.py", self.folder, "0.8", "path.txt", *where, folder=self.folder)

    def test_plan(self) -> None:
        scene.write_folder(edgevo.simulate("street", frames=(0, 50)), self.folder)
        done = self.plan("--camera-height", "1.65")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        path = np.loadtxt(f"{self.folder}/path.txt")
        # From where the drive ended to where it began, along x, in metres.
        self.assertGreater(path[0, 0] - path[-1, 0], 30)
        self.assertLess(np.linalg.norm(np.diff(path, axis=0), axis=1).max(), 1)

    def test_plan_in_an_earlier_map(self) -> None:
        scene.write_folder(edgevo.simulate("street", frames=(0, 50)), self.folder)
        run = edgevo.run(self.folder, scale="camera_height=1.65")
        run.save(f"{self.folder}/earlier")
        done = self.plan("--map", "earlier")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        found = [float(number) for number in re.findall(r"-?\d+\.\d\d", done.stdout.splitlines()[-1])]
        x, y, from_path, to_go = found
        again = edgevo.load_run(f"{self.folder}/earlier")
        self.assertEqual(edgevo.Map(again).resolution, edgevo.Map(run).resolution)
        # At its end, in the axes of the map, as the earlier drive was there.
        end = (run.T_map_world @ run.poses[-1])[:2, 3]
        self.assertLess(np.linalg.norm(end - (x, y)), 0.2)
        self.assertLess(from_path, 1)
        self.assertLess(to_go, 1)

    def test_evo_plot(self) -> None:
        done = start(EXAMPLES / "evo_plot.py", "source", "truth.txt", "plot.png", folder=self.folder)
        if done.returncode == 77:
            self.assertEqual(done.stderr, "SKIPPED: evo is not installed; pip install evo\n")
            self.skipTest(done.stderr.strip())
        self.assertIn("source: no such file or folder", done.stderr)

    def test_the_pages(self) -> None:
        for program in tutorial.write_blocks(pathlib.Path(self.folder)):
            done = start(program, folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
