#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Some sixty bad inputs as a hurried user gives them: devices, pipes, torn and empty files, invalid numbers, impossible outputs.
# No command crashes, runs forever or destroys files; each gives one clear line and exit code 2.
. "$(dirname "$0")/cli_common.sh"
desk=$scenes/desk result=$scenes/runs/desk
# bad WORDS COMMAND...: complains within half a minute.
bad() {
  pattern=$1
  shift
  complains "$pattern" timeout 30 "$@"
}
# run WORDS SOURCE [OPTION...]
run() {
  words=$1 source=$2
  shift 2
  bad "$words" "$edgevo" run "$source" -o out --quiet "$@"
}
nothing_left() { check "partial outputs" "$(ls -d out out.rawlog out_Images 2>/dev/null | wc -l)" -eq 0; }
mkfifo pipe pipe.rawlog pipe.yaml
mkdir folder
: >empty
head -c 3000 "$desk/images/000000.png" >torn.png
head -c 100000 /dev/urandom >noise

run "is the folder of a run, not of images; read its summary.yaml" "$result"

# Cameras.
camera() { run "$1" "$desk" --camera "$2"; }
camera "zero: cannot be read: it is a device or a pipe" /dev/zero
camera "pipe: cannot be read: it is a device or a pipe" pipe
camera "folder: is a folder without COLMAP.s cameras.txt" folder
camera "empty.*camera\|empty: " empty
truncate -s 3G huge
camera "huge: cannot be read: it is larger than 2 GB" huge
numbers() { echo "$2" >numbers.txt && camera "numbers.txt.*$1" numbers.txt; }
numbers "not a finite number" "nan 500 320 240 0 0 0 0 640 480"
numbers "above a million" "1e30 500 320 240 0 0 0 0 640 480"
numbers "below one pixel" "0.78 1.04 320 240 0 0 0 0 640 480"
numbers "principal point" "500 500 3200 240 0 0 0 0 640 480"
numbers "" "500 500 320 240 0 0 0 0 1e12 480"
numbers "not a finite number\|is not a number" "500 500 320 240 1e999 0 0 0 640 480"
echo "500 500 160 100 0 0 0 0 320 200" >small.txt
camera "the image is 640x480, but the camera model is for 320x200, of another shape" small.txt
echo "500 500 120 160 0 0 0 0 240 320" >upright.txt
camera "the camera model is for 240x320: the images are turned" upright.txt
printf 'image_width: 640\nimage_height: 480\ncamera_matrix:\n  rows: 3\n' >torn.yaml
camera "torn.yaml" torn.yaml

# Parameters.
run "urandom: cannot be read: it is a device" "$desk" --params /dev/urandom
run "noise" "$desk" --params noise
for value in nan 1e999; do run "canny_percentile" "$desk" --set edges.canny_percentile=$value; done
run "scale.*number" "$desk" --scale factor=1e999
run "neither stop nor skip" "$desk" --on-bad-frame perhaps
run "on-bad-frame" "$desk" --on-bad-frame
run "frames" "$desk" --frames 99999999999999999999:
run "needs --realtime\|requires --realtime" "$desk" --pace 30

# Sources.
source_of() { run "$@"; }
source_of "zero: is a device or a pipe, not a file" /dev/zero --camera "$desk/camera.txt"
source_of "pipe: is a device or a pipe" pipe --camera "$desk/camera.txt"
source_of "pipe.rawlog: is a device or a pipe" pipe.rawlog
source_of "noise: is neither a rawlog nor a video" noise --camera "$desk/camera.txt"
cp torn.png picture.rawlog
source_of "picture.rawlog" picture.rawlog
cp noise noise.rawlog
source_of "noise.rawlog" noise.rawlog
mkdir box.rawlog
source_of "box.rawlog.*no images" box.rawlog
ln -s /nowhere dangling
source_of "dangling: no such file" dangling
# sequence NAME: the first frames of the desk, to be damaged.
sequence() { rm -rf "$1" && copy_sequence "$desk" "$1" 0 5; }
sequence lines && echo "1.0" >>lines/times.txt
source_of "6 times for 5 images" lines
sequence noon && sed -i '3s/.*/noon/' noon/times.txt
source_of "times.txt, line 3: 'noon' is not a time" noon
sequence piped && rm piped/times.txt && mkfifo piped/times.txt
source_of "times.txt" piped
sequence cameras && rm cameras/camera.txt && mkfifo cameras/camera.txt
source_of "camera.txt" cameras
sequence backwards && sort -r "$desk/times.txt" | head -5 >backwards/times.txt
source_of "is not after the frame before" backwards --on-bad-frame stop && rm -rf out
sequence first && rm first/images/000000.png && cp torn.png first/images/000000.png
source_of "000000.png: the image does not decode" first
sequence file && rm -r file/images && : >file/images
source_of "file: the folder holds no images" file
mkdir -p kitti/image_0 && cp torn.png kitti/image_0/000000.png && echo 0 >kitti/times.txt && echo "P0: 1 2 nan" >kitti/calib.txt
source_of "kitti" kitti
mkdir freiburg1 && echo "1.0 rgb/none.png" >freiburg1/rgb.txt
source_of "none.png: the image is missing" freiburg1
mkdir -p euroc/mav0/cam0 && cp noise euroc/mav0/cam0/data.csv
source_of "data.csv" euroc

# Images of several kinds, and readings that do not fit.
mkdir pair && for i in 0 1 2 3; do for side in left right; do ln -s "$desk/images/00000$i.png" pair/00000${i}_$side.png; done; done
source_of "several series: #_left.png (4), #_right.png (4); choose one" pair --camera "$desk/camera.txt"
source_of "middle.*matches none of the images" pair --camera "$desk/camera.txt" --images 'middle*'
source_of "is of no use: freiburg1 lists its images itself" freiburg1 --images '*'
source_of "is of no use: the images have 8 bits" "$desk" --bits 12
source_of "bits" "$desk" --bits 17
source_of "time-unit" "$desk" --time-unit hours
nothing_left

# Outputs.
out() { bad "$1" "$edgevo" run "$desk" -o "$2" --quiet; }
out "cannot be created" /proc/out
out "cannot be created\|cannot be written" "$(printf 'x%.0s' $(seq 300))"
out "dangling" dangling
out "pipe: is a file" pipe

# Other commands.
bad "pipe: cannot be read: it is a device or a pipe" "$edgevo" eval pipe "$desk/groundtruth_tum.txt"
bad "zero: cannot be read: it is a device" "$edgevo" eval "$result/trajectory_tum.txt" /dev/zero
bad "noise" "$edgevo" eval noise "$desk/groundtruth_tum.txt"
echo "0 0 0 nan 0 0 0 1" >nan.txt
bad "not finite" "$edgevo" eval nan.txt "$desk/groundtruth_tum.txt"
for resolution in nan 1e999; do bad "resolution.*number" "$edgevo" map "$result" -o out --resolution=$resolution; done
bad "reach only .*; give a resolution of" "$edgevo" map "$result" -o out --resolution 0.0000001
bad "empty: holds no interrupted run" "$edgevo" finish empty
mkdir garbage && cp noise garbage/unfinished_run.bin
bad "is incomplete or no recovery log" "$edgevo" finish garbage
bad "pipe.yaml: cannot be read: it is a device or a pipe" "$edgevo" bench pipe.yaml -o out
bad "zero" "$edgevo" simulate /dev/zero -o out
bad "empty" "$edgevo" calibrate empty -o out
bad "is a device or a pipe" "$edgevo" import pipe out.rawlog
bad "is a device or a pipe" "$edgevo" info pipe
nothing_left
finish
