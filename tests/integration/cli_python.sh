#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The Python package next to the program: the same bytes on the same sequences.
. "$(dirname "$0")/cli_common.sh"
PYTHONPATH=$(cd "$(dirname "$edgevo")/.." && pwd)/python
export PYTHONPATH
python() { /usr/bin/python3 "$@"; }
python -c 'import edgevo' 2>/dev/null || skip "the Python package cannot be imported (numpy?)"

cat >run.py <<'END'
import sys
import edgevo

source, out = sys.argv[1:]
edgevo.run(source).save(out)
frames = edgevo.open_source(source)
odometry = edgevo.Odometry(frames.camera)
for frame in frames:
    odometry.process(frame.image, frame.time_ns)
odometry.finish().to_tum(out + "/by_array.txt")
END
for name in street desk; do
  run_code 0 python run.py "$scenes/$name" "$name"
  for file in trajectory_tum.txt trajectory_live_tum.txt trajectory_kitti.txt edges.ply edges.bt grid.pgm covariances.csv graph.csv run.mcap map.db; do
    same "$name: $file of the program and of Python" "$scenes/runs/$name/$file" "$name/$file"
  done
  same "$name: the poses by arrays" "$scenes/runs/$name/trajectory_tum.txt" "$name/by_array.txt"
done

run_code 1 python -c 'import edgevo; edgevo.run("nowhere")'
check "the words of the program" "$(grep -c '^edgevo.InputError: nowhere: no such file or folder' stderr)" -eq 1

finish
