#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A camera that is tilted or turned on its vehicle: its mount given with --mount, in the camera file, in a rawlog, or seen; the map is
# level then.
. "$(dirname "$0")/cli_common.sh"

# Slope of the way in the map's axes, degrees.
way() {
  awk '/^[0-9]/ { x = $2; y = $3; z = $4 } END { s = atan2(z, sqrt(x * x + y * y)) * 57.2958; print s < 0 ? -s : s }' "$1/trajectory_vehicle_tum.txt"
}
# Slope of the ground under the way, degrees: a line through the low ends of the edges within 3 m of it.
ground() {
  awk -F, 'NR > 1 && $5 < 3 && $5 > -3 && $6 < -1 { n++; x += $4; z += $6; xx += $4 * $4; xz += $4 * $6 }
    END { if (n < 50) exit; s = atan2(n * xz - x * z, n * xx - x * x) * 57.2958; print s < 0 ? -s : s }' "$1/edge_segments.csv"
}
"$edgevo" simulate street --frames 0:70 --mount 0,20,0 -o down >/dev/null || fail "simulate"
check "SOURCE.md has the mount" "$(grep -c -e '--mount 0.000,20.000,0.000' down/SOURCE.md)" -eq 1

# Seen, without a word from the user.
run_code 0 "$edgevo" run down -o seen --scale camera_height=1.65
check "what was seen is said" "$(grep -c 'mount: looks [12][0-9.]* degrees down .*(seen: direction of travel, ground' stderr)" -eq 1
check "and is in summary.yaml" "$(grep -c 'mount: .*seen: direction of travel' seen/summary.yaml)" -eq 1
below "slope of the way, mount seen" "$(way seen)" 1
below "slope of the ground, mount seen" "$(ground seen)" 1

# Given, rightly and wrongly.
run_code 0 "$edgevo" run down -o given --scale camera_height=1.65 --mount 0,20,0
check "where the mount is from" "$(grep -c 'mount: looks 20.0 degrees down .*(--mount)' stderr)" -eq 1
below "slope of the way, mount given" "$(way given)" 1
below "slope of the ground, mount given" "$(ground given)" 1
# By a wrong mount the road climbs: no ground at one height, and no metres.
complains "the edges show no ground at one height" "$edgevo" run down -o wrong --scale camera_height=1.65 --mount 0,0,0 --quiet
below "slope of the way by a wrong mount, 20 degrees less" "$(way wrong | awk '{ d = $1 - 20; print d < 0 ? -d : d }')" 1
run_code 0 "$edgevo" map wrong -o mended --mount 0,20,0
run_code 0 "$edgevo" run down -o plain --mount 0,20,0 --quiet
check "height of the mended grid within four cells" \
  "$(tail -n +1 mended/grid.pgm plain/grid.pgm | grep -a -E '^[0-9]+ [0-9]+$' | awk '{ h[NR] = $2 } END { d = h[1] - h[2]; print d < 0 ? -d : d }')" -le 4

# In the camera file, as numbers and YAML; in a rawlog; an option beats both.
read -r fx fy cx cy k1 k2 p1 p2 width height k3 <<NUMBERS
$(grep -v '^#' down/camera.txt)
NUMBERS
cat >camera.yaml <<YAML
image_width: $width
image_height: $height
camera_matrix: {rows: 3, cols: 3, data: [$fx, 0, $cx, 0, $fy, $cy, 0, 0, 1]}
distortion_coefficients: {rows: 1, cols: 5, data: [$k1, $k2, $p1, $p2, $k3]}
mount: [0, 20, 0, 0.5, 0, 1.2]
YAML
"$edgevo" info down --camera camera.yaml >info.txt || fail "info with a mount in the camera file"
check "the mount of the camera file" "$(grep -c 'mount .*at x 0.500, y 0.000, z 1.200 m; looks .* -20.0 deg up' info.txt)" -eq 1
check "and where it is from" "$(grep -c 'mount .*20.0 degrees down .*(camera.yaml)' info.txt)" -eq 1
"$edgevo" import down down.rawlog --mount 0,20,0 --frames 0:5 >/dev/null || fail "import with a mount"
"$edgevo" info down.rawlog --mount 0,-5,0 >info.txt || fail "info with two mounts"
check "that of the rawlog is not used" "$(grep -c 'looks 5.0 degrees up .*--mount; that of the source, which looks 20.0 degrees down .*is not used' info.txt)" -eq 1
sed -i 's/^mount: .*/mount: [0, 20]/' camera.yaml
complains "camera.yaml: mount: holds 2 numbers" "$edgevo" info down --camera camera.yaml
complains "0,20,0 is a camera 20 degrees down" "$edgevo" run down -o never --mount 20
complains "beyond 360 degrees" "$edgevo" run down -o never --mount 0,2000,0
complains "beyond a kilometre" "$edgevo" simulate street -o never --mount 0,20,0,0,0,1650
[ ! -e never ] || fail "a folder was made for an invalid mount"

# Turned by 90 degrees.
"$edgevo" simulate street --frames 0:70 --mount 90,0,0 -o turned >/dev/null || fail "simulate a turned camera"
run_code 0 "$edgevo" run turned -o side --scale camera_height=1.65 --mount 90,0,0 --quiet
below "slope of the ground, turned camera" "$(ground side)" 1
check "the ground is known to the grid" "$(grep -c '^# heights' side/grid.yaml)" -eq 1
finish
