#!/bin/sh
# Downloads images, depth and poses of one release of Virtual KITTI into the folder TARGET.
set -eu
usage() { echo "usage: fetch.sh TARGET 1.3.1|2.0.3, for example fetch.sh ~/vkitti 2.0.3" >&2; exit 2; }
[ $# -eq 2 ] || usage
case $2 in
  1.3.1) folder=virtual-kitti-1.3.1 archives="vkitti_1.3.1_rgb.tar vkitti_1.3.1_depthgt.tar vkitti_1.3.1_extrinsicsgt.tar.gz" ;;
  2.0.3) folder=virtual_kitti_2.0.3 archives="vkitti_2.0.3_rgb.tar vkitti_2.0.3_depth.tar vkitti_2.0.3_textgt.tar.gz" ;;
  *) usage ;;
esac
mkdir -p "$1"
cd "$1"
for archive in $archives; do
  curl -fL -C - -O "https://download.europe.naverlabs.com/$folder/$archive"
  tar -xf "$archive"
done
