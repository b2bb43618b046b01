#!/bin/sh
# Downloads gray images (22 GB), calibration and poses of KITTI odometry into the folder TARGET.
set -eu
[ $# -eq 1 ] || { echo "usage: fetch.sh TARGET" >&2; exit 2; }
mkdir -p "$1"
cd "$1"
for name in data_odometry_calib data_odometry_poses data_odometry_gray; do
  curl -fL -C - -o "$name.zip" "https://s3.eu-central-1.amazonaws.com/avg-kitti/$name.zip"
  unzip -n -q "$name.zip"
done
