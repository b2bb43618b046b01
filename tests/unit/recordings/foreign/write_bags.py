#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Writes FOLDER/rosbag_{none,bz2,lz4}.bag by Debian's python3-rosbag and python3-sensor-msgs: see README.md.
import sys

import genpy
import rosbag
from sensor_msgs.msg import Image

for compression in 'none', 'bz2', 'lz4':
    with rosbag.Bag(f'{sys.argv[1]}/rosbag_{compression}.bag', 'w', compression=compression) as bag:
        for i in range(3):
            image = Image(width=16, height=12, encoding='mono8', step=16)
            image.header.stamp = genpy.Time(1600000000, i * 50000000)
            image.header.frame_id = 'cam'
            image.data = bytes((7 * k + 13 * i) % 256 for k in range(16 * 12))
            bag.write('/cam/image_raw', image, image.header.stamp + genpy.Duration(0, 1000000))
