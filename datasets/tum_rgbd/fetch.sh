#!/bin/sh
# Downloads a sequence of TUM RGB-D, such as freiburg1_xyz, into the folder TARGET.
set -eu
[ $# -eq 2 ] || { echo "usage: fetch.sh TARGET SEQUENCE, for example fetch.sh ~/tum freiburg1_xyz" >&2; exit 2; }
mkdir -p "$1"
cd "$1"
name="rgbd_dataset_$2"
camera="${2%%_*}"
curl -fL -C - -o "$name.tgz" "https://cvg.cit.tum.de/rgbd/dataset/$camera/$name.tgz"
tar xzf "$name.tgz"
