# SPDX-License-Identifier: BSD-3-Clause
"""Live poses of a camera that OpenCV opens.

    webcam.py CAMERA.yaml [SOURCE]

SOURCE is the number of a camera (default 0), or a video or pattern of images (images/%06d.png), which are played as
fast as they are processed. Ctrl-C ends the run; its map is then saved in `webcam_run`.
"""

import sys
import time

import cv2
import edgevo


def say_pose(record: edgevo.Record) -> None:
    T = record.T_world_cam
    if T is None:
        print(f"{record.time:.3f} {record.state.name}: {record.note}")
    else:
        x, y, z = T[:3, 3]
        print(f"{record.time:.3f} {record.state.name} x={x:.3f} y={y:.3f} z={z:.3f}")


def follow(capture: cv2.VideoCapture, is_live: bool, odometry: edgevo.Odometry) -> None:
    while True:
        there, image = capture.read()  # H x W x 3, blue, green, red; read() fills the same memory again
        if not there:
            return
        seconds = time.time() if is_live else capture.get(cv2.CAP_PROP_POS_MSEC) / 1000
        say_pose(odometry.process(image, seconds))


def main(arguments: list[str]) -> int:
    if len(arguments) not in (1, 2):
        print(__doc__)
        return 2
    source = arguments[1] if len(arguments) == 2 else "0"
    is_live = source.isdigit()
    capture = cv2.VideoCapture(int(source) if is_live else source)
    if not capture.isOpened():
        print(f"{source}: OpenCV cannot open it")
        return 2
    odometry = edgevo.Odometry(edgevo.read_camera(arguments[0]), realtime=True, log=print)
    try:
        follow(capture, is_live, odometry)
    except KeyboardInterrupt:
        pass
    run = odometry.finish()
    run.save("webcam_run")
    print(run)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except edgevo.InputError as error:
        sys.exit(f"webcam.py: {error}")
