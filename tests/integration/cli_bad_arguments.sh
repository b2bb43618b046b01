#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What cannot be run is reported at once: one line with where, what and what to do, and exit code 2.
. "$(dirname "$0")/cli_common.sh"
desk=$scenes/desk
run() { "$edgevo" run "$@" --quiet; }

# The command line.
complains "no sub-command given" "$edgevo"
complains "'rum'.*did you mean run" "$edgevo" rum "$desk" -o out
complains "SOURCE is required" "$edgevo" run
complains "\-\-out is required; add -o and a name" "$edgevo" run "$desk"
complains "is no sub-command; edgevo run .*desk -o OUT runs it" "$edgevo" "$desk"
complains "run: unknown option --detektor; did you mean --detector?" "$edgevo" run "$desk" -o out --detektor=canny
complains "extra" "$edgevo" run "$desk" extra -o out
complains "'' names no folder" "$edgevo" run "$desk" -o ''
complains "SOURCE is required" "$edgevo" import
complains "does not end in .rawlog" "$edgevo" import "$desk" seq.log
complains "no-scene.*street" "$edgevo" simulate no-scene -o out
for seconds in -0.1 1e999; do complains "rolling-shutter.*number, 0 or larger" "$edgevo" simulate desk -o out --rolling-shutter=$seconds; done
complains "exposure of 0.5.* s is out of range; give 0 to 0.03" "$edgevo" simulate desk -o out --exposure 0.5
complains "none.txt" "$edgevo" eval none.txt "$desk/groundtruth_tum.txt"

complains "unknown option --versio; did you mean --version?" "$edgevo" --versio
complains "option --quiet stands before the sub-command; write it after its own: .*run" "$edgevo" --quiet run "$desk" -o out
# --set takes one value, whatever follows it.
complains "'7' is out of range.*between" "$edgevo" run --set edges.canny_percentile=7 "$desk" -o out --quiet
complains "set edges.detector=canny: is of no use for a map; set parameters of occupancy or grid" "$edgevo" map "$scenes/runs/desk" \
  --set edges.detector=canny -o out

# More ranges are in tests/unit/datasets/frame_range_test.cpp.
for range in 5 9:5 1000:1001; do complains "--frames" run "$desk" -o out --frames=$range; done
for every in 0 2.5 99999999999; do complains "--every.*whole number" run "$desk" -o out --every=$every; done
complains "--seed.*whole number" run "$desk" -o out --seed=-1
for fov in 0 180 wide; do complains "--fov.*number from 1 to 179" run "$desk/images" -o out --fov=$fov; done
complains "image-scale.*number from 0.01 to 1" run "$desk" -o out --image-scale=2
complains "image-scale 0.010: is too small" run "$desk" -o out --image-scale=0.01
for fps in 0 x; do complains "--fps.*larger than 0" run "$desk" -o out --fps=$fps; done

# Parameters: the nearest name, the range, the file and its line.
complains "unknown parameter 'edges.canny_percentil'.*did you mean 'edges.canny_percentile'" run "$desk" -o out --set edges.canny_percentil=0.9
complains "'7' is out of range.*between" run "$desk" -o out --set edges.canny_percentile=7
complains "'many' is not a number" run "$desk" -o out --set edges.canny_percentile=many
complains "association.patch_side: '4' is even; write an odd number" run "$desk" -o out --set association.patch_side=4
complains "is not KEY=VALUE" run "$desk" -o out --set nonsense
complains "'cany' is not one of.*did you mean canny" run "$desk" -o out --detector cany
printf 'edges:\n  detector: canny\n  canny_percentil: 0.9\n' >unknown.yaml
printf 'edges:\n  canny_percentile: 9\n' >range.yaml
printf 'edges: [1\n' >broken.yaml
complains "unknown.yaml:3: unknown parameter.*did you mean" run "$desk" -o out --params unknown.yaml
complains "range.yaml:2: .*out of range" run "$desk" -o out --params range.yaml
complains "broken.yaml:1: " run "$desk" -o out --params broken.yaml
complains "none.yaml: cannot be read" run "$desk" -o out --params none.yaml

complains "'9' is out of range" run --params range.yaml "$desk" -o out
# The parameters of a run are in its summary.yaml.
sed 's/^    canny_percentile: .*/    canny_percentile: 9/' "$scenes/runs/desk/summary.yaml" >summary.yaml
complains "summary.yaml:[0-9]*: edges.canny_percentile: '9' is out of range" run "$desk" -o out --params summary.yaml
run_code 0 "$edgevo" run "$desk" -o of_summary --params "$scenes/runs/desk/summary.yaml" --frames 0:40
check "the line that says so" "$(grep -c 'summary.yaml: its block .parameters. is used' stderr)" -eq 1
check "parameters that differ" "$(for out in of_summary "$scenes/runs/desk"; do sed -n '/^parameters:/,/^[a-oq-z]/p' "$out/summary.yaml"; done |
  sort | uniq -u | wc -l)" -eq 0

# Sources that do not exist or are no sources.
mkdir empty only_images letter
ln -s "$desk/images" only_images/images
echo "Dear camera" >letter.txt
: >nothing.rawlog
complains "nowhere: no such file or folder" run nowhere -o out
complains "empty: the folder holds no images" run empty -o out
complains "times.txt: is missing" run only_images -o out
complains "no calibration.*--camera" run "$desk/images" -o out
complains "letter.txt.*neither a rawlog nor a video" run letter.txt -o out
complains "nothing.rawlog: the file is empty" run nothing.rawlog -o out
complains "--fps: is of no use: .* has times of its own" run "$desk" -o out --fps 10
complains "--time-unit: is of no use" run nothing.rawlog -o out --time-unit ms
complains "no sensor 'CAM7'" run "$desk" -o out --sensor CAM7
complains "none.txt" run "$desk" -o out --camera none.txt
echo "500 500 320 240 0 0" >short_camera.txt
complains "short_camera.txt" run "$desk" -o out --camera short_camera.txt
echo "500 500 320 240 0 0 0 0 640 -480" >bad_camera.txt
complains "bad_camera.txt" run "$desk" -o out --camera bad_camera.txt
complains "camera:0.*no calibration.*--camera" run camera:0 -o out
complains "camera:x" run camera:x -o out --camera "$desk/camera.txt"
complains "camera:250: the camera does not open; check that it is plugged in" run camera:250 -o out --camera "$desk/camera.txt"
check "folders left by commands that cannot run" "$(ls -d out 2>/dev/null | wc -l)" -eq 0

# Outputs that cannot be made.
: >file
complains "file: is a file, but a folder is needed" run "$desk" -o file
complains "file/out: cannot be created" run "$desk" -o file/out
finish
