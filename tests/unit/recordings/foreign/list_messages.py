#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# What tests/integration/list_messages prints, of a .bag by Debian's python3-rosbag and of a .db3 by Python's sqlite3.
import sqlite3
import sys
import zlib


def messages(path):
    if path.endswith('.db3'):
        rows = 'SELECT timestamp, name, data FROM messages JOIN topics ON topics.id = topic_id'
        yield from sqlite3.connect(path).execute(rows)
        return
    import rosbag
    for topic, (_, data, *_), time in rosbag.Bag(path).read_messages(raw=True):
        yield time.to_nsec(), topic, data


for time, topic, data in messages(sys.argv[1]):
    print(time, topic, len(data), f'{zlib.crc32(data):08x}')
