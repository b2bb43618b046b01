#!/bin/sh
# Downloads a sequence of EuRoC, such as machine_hall/MH_01_easy or vicon_room1/V1_01_easy, into the folder TARGET.
set -eu
[ $# -eq 2 ] || { echo "usage: fetch.sh TARGET GROUP/SEQUENCE, for example fetch.sh ~/euroc machine_hall/MH_01_easy" >&2; exit 2; }
mkdir -p "$1"
cd "$1"
name="${2##*/}"
curl -fL -C - -o "$name.zip" "http://robotics.ethz.ch/~asl-datasets/ijrr_euroc_mav_dataset/$2/$name.zip"
mkdir -p "$name"
unzip -n -q -d "$name" "$name.zip"
