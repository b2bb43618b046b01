#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A fisheye from its camera file to its map: rendered, described, rectified, and tracked as well as a pinhole.
. "$(dirname "$0")/cli_common.sh"

# lens_file NAME FOCAL COEFFICIENTS: 512x384 pixels.
lens_file() {
  cat <<YAML
image_width: 512
image_height: 384
camera_matrix: {rows: 3, cols: 3, data: [$2, 0, 255.5, 0, $2, 191.5, 0, 0, 1]}
distortion_model: $1
distortion_coefficients: {rows: 1, cols: $(echo "$3" | tr ',' '\n' | wc -l), data: [$3]}
YAML
}
lens_file equidistant 155 "0.0034, 0.00076, -0.00099, 0.00021" >fisheye.yaml
"$edgevo" info fisheye.yaml >info.txt || fail "info on a camera file"
check "its view" "$(grep -c 'field of view  *18[0-9].[0-9] x 14[0-9].[0-9] deg' info.txt)" -eq 1
check "its lens" "$(grep -c 'k1 0.0034, .*kannala_brandt' info.txt)" -eq 1
check "how rows bend" "$(grep -c '^rows bend by .*+' info.txt)" -eq 1
check "and what a run would see" "$(grep -c '^rectified .*120 x 120 degrees' info.txt)" -eq 1

run_code 0 "$edgevo" simulate corridor --camera fisheye.yaml --frames 0:110 -o fisheye
check "the camera file is in the folder" "$("$edgevo" info fisheye | grep -c kannala_brandt)" -ge 1
run_code 0 "$edgevo" run fisheye -o run
check "the pinhole is said" "$(grep -c 'rectified: to a pinhole of .* 120 x 120 degrees.*cut off' stderr)" -eq 1
check "and in summary.yaml" "$(grep -c 'rectified: .to a pinhole' run/summary.yaml)" -eq 1
check "the lens in summary.yaml" "$(grep -c '^  lens: .*kannala_brandt' run/summary.yaml)" -eq 1
below "ATE in metres (path 7 m)" "$(ate run fisheye)" 0.1
check "frames with a pose" "$(poses run)" -ge 105

run_code 0 "$edgevo" run fisheye --rectify-fov 90 --rectify-size 400x300 -o smaller --frames 0:40
check "a requested pinhole" "$(grep -c 'rectified: to a pinhole of 400x300 and 90 x ' stderr)" -eq 1
complains "is not WIDTHxHEIGHT" "$edgevo" run fisheye --rectify-size 400 -o never
complains "not a number from 10 to 150" "$edgevo" run fisheye --rectify-fov 180 -o never

# A lens that MRPT lacks, in a rawlog and back.
lens_file double_sphere 130 "-0.2, 0.58" >ds.yaml
run_code 0 "$edgevo" simulate corridor --camera ds.yaml --frames 0:3 -o ds.rawlog
check "as the closest fisheye" "$("$edgevo" info ds.rawlog | grep -c kannala_brandt)" -ge 1
[ ! -e never ] || fail "a folder was made for an invalid pinhole"
finish
