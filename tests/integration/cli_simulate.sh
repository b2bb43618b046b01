#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# edgevo simulate: folder and rawlog have the same contents, exposure and rolling shutter, and invalid scenes.
shipped=$(cd "$(dirname "$0")/../../datasets/scenes" && pwd)
. "$(dirname "$0")/cli_common.sh"

# A rawlog from the renderer equals, byte for byte, an import of the folder.
"$edgevo" simulate desk --frames 0:12 -o folder >/dev/null || fail "simulate into a folder"
"$edgevo" import folder imported.rawlog >/dev/null || fail "import of that folder"
"$edgevo" simulate desk --frames 0:12 -o made/desk.rawlog >said || fail "simulate into a rawlog"
check "frames in its message" "$(grep -c '12 frames, images in .*desk_Images, ground truth next to it' said)" -eq 1
same "rawlog" made/desk.rawlog imported.rawlog
same "ground truth" made/desk_groundtruth_tum.txt imported_groundtruth_tum.txt
check "images" "$(ls made/desk_Images | wc -l)" -eq 12
for image in made/desk_Images/*; do cmp -s "$image" "imported_Images/$(basename "$image")" || fail "$image differs"; done
"$edgevo" info made/desk.rawlog --check >info.txt || fail "info on the rawlog and its images"
check "images that decode" "$(grep -c '^frames  *12' info.txt)" -ge 1
complains "a rawlog does not hold depth" "$edgevo" simulate desk -o x.rawlog --depth
complains "a rawlog does not hold true edges" "$edgevo" simulate desk -o x.rawlog --edges
complains "frames 400:500 are not in it" "$edgevo" simulate rotation --frames 400:500 -o x.rawlog
[ ! -e x.rawlog ] || fail "there is a rawlog of missing frames"

# Exposure and rolling shutter: other images, the same poses and depth, reproducible.
shuttered() { "$edgevo" simulate rotation --frames 20:22 --depth --exposure 0.02 --rolling-shutter 0.03 -o "$1" >/dev/null; }
shuttered once && shuttered twice || fail "simulate with a shutter"
"$edgevo" simulate rotation --frames 20:22 --depth -o sharp >/dev/null || fail "simulate without a shutter"
same "image through a shutter, again" once/images/000020.png twice/images/000020.png
differ "image with and without a shutter" once/images/000020.png sharp/images/000020.png
same "poses" once/groundtruth_tum.txt sharp/groundtruth_tum.txt
same "depth" once/depth/000020.pfm sharp/depth/000020.pfm
check "SOURCE.md has the command" "$(grep -c -e '--rolling-shutter 0.03 --exposure 0.02 -o' once/SOURCE.md)" -eq 1

# True edges are written next to the images, whatever the shutter, and are removed when the folder is written without them.
"$edgevo" simulate rotation --frames 20:22 --edges --exposure 0.02 -o labelled >/dev/null || fail "simulate with true edges"
"$edgevo" simulate rotation --frames 20:22 --edges -o relabelled >/dev/null || fail "the same without a shutter"
check "label images" "$(ls labelled/edges | wc -l)" -eq 2
same "labels" labelled/edges/000021.png relabelled/edges/000021.png
"$edgevo" simulate rotation --frames 20:22 --force -o labelled >/dev/null || fail "simulate into the same folder"
[ ! -e labelled/edges ] || fail "labels of an earlier call are left"

# Traffic and an own part come with masks, and only with them.
run_code 0 "$edgevo" simulate street --frames 75:77 --traffic lorry --own-part bonnet -o traffic
check "masks of traffic" "$(ls traffic/masks | wc -l)" -eq 2
[ -f traffic/mask.png ] || fail "mask of the own part"
check "SOURCE.md has the command" "$(grep -c -e '--traffic lorry --own-part bonnet' traffic/SOURCE.md)" -eq 1
run_code 0 "$edgevo" simulate street --frames 75:77 --force -o traffic
[ ! -e traffic/masks ] && [ ! -e traffic/mask.png ] || fail "masks of an earlier call are left"
complains "did you mean lorry" "$edgevo" simulate street --traffic lory -o x
complains "less than 10 m" "$edgevo" simulate desk --traffic lorry -o x
complains "name a folder" "$edgevo" simulate street --traffic lorry -o x.rawlog

# Invalid scenes. bad SCENE SED_SCRIPT WORDS
bad() {
  sed "$2" "$shipped/$1.yaml" >bad.yaml
  complains "$3" "$edgevo" simulate bad.yaml -o never
}
line_of() { grep -n "^ *$2" "$shipped/$1.yaml" | head -1 | cut -d: -f1; }
bad desk 's/rate_hz:/rate_hertz:/' "bad.yaml:$(line_of desk rate_hz:): unknown parameter 'rate_hertz'.*rate_hz"
bad desk 's/walls: .*/walls: plastre/' "bad.yaml:$(line_of desk walls:): there is no texture 'plastre'.*'plaster'"
bad street 's/lane_offset: .*/lane_offset: 11/' "bad.yaml:$(line_of street way_points:): the camera passes through a wall"
bad street 's/^frames: .*/frames: 0/' "bad.yaml:$(line_of street frames:): frames: '0' is out of range"
bad street '/^frames:/d' "bad.yaml: frames is missing"
bad street 's/  - \[105, 0\]/  - [105 0]/' "bad.yaml:$(($(line_of street way_points:) + 2)): is not a waypoint"
[ ! -e never ] || fail "a folder was made for an invalid scene"
finish
