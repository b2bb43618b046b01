#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Metric scale: every source of --scale on a rendered sequence of known length, maps in metres, `edgevo map` at other resolutions,
# and sources that are missing.
#   cli_scale.sh EDGEVO SCENES ADD_VEHICLE_SENSORS
. "$(dirname "$0")/cli_common.sh"
add_sensors=${3:?usage: $0 EDGEVO SCENES ADD_VEHICLE_SENSORS}
sequence=$scenes/street

# length FILE: length of the path.
length() { awk '/^[0-9]/ { if (n++) s += sqrt(($2-x)^2 + ($3-y)^2 + ($4-z)^2); x = $2; y = $3; z = $4 } END { print s }' "$1"; }
# within WHAT OUT PERCENT: the path length of OUT equals the true one over the same frames within PERCENT.
within() {
  first=$(awk '/^[0-9]/ { print $1; exit }' "$2/trajectory_tum.txt")
  awk -v t="$first" '/^[0-9]/ && $1 >= t - 1e-6' "$sequence/groundtruth_tum.txt" >truth.txt
  below "$1: length $(length "$2/trajectory_tum.txt") of $(length truth.txt) m, error in percent" \
    "$(awk -v a="$(length "$2/trajectory_tum.txt")" -v b="$(length truth.txt)" 'BEGIN { e = 100 * (a / b - 1); print e < 0 ? -e : e }')" "$3"
}
value() { sed -n "/^$2:/,/^[a-z]/s/^  $3: *//p" "$1/summary.yaml"; }

"$edgevo" import "$sequence" street.rawlog >/dev/null || fail "import"
"$add_sensors" street.rawlog "$sequence/groundtruth_tum.txt" sensors.rawlog 3 || fail "add_vehicle_sensors"
ln -s street_Images sensors_Images

run_code 0 "$edgevo" run "$sequence" -o height --scale camera_height=1.65 --quiet
within "camera_height" height 3
for sensor in odometry robot_pose gps; do run_code 0 "$edgevo" run sensors.rawlog -o $sensor --scale $sensor --quiet; done
within "odometry with 2 % of noise" odometry 1
within "robot_pose" robot_pose 0.5
within "gps with 0.5 m of noise" gps 5

run_code 0 "$edgevo" run sensors.rawlog -o several --scale odometry,gps,camera_height=1.65 --quiet
within "three sources" several 1
check "no source is named" "$(grep -c '^scale_faults: \[\]' several/summary.yaml)" -eq 1
check "all sources in the report" \
  "$(grep -o -e 'compared with the odometry' -e 'compared with GPS' -e 'm above the ground' several/report.html | sort -u | wc -l)" -eq 3

check "metric: true" "$(value height scale metric | grep -c true)" -eq 1
check "an uncertainty in summary.yaml" "$(value height scale relative_standard_deviation | grep -c '^0\.0[0-9]*[1-9]')" -eq 1
check "rows of scale.csv" "$(awk 'END { print NR - 1 }' height/scale.csv)" -eq "$(wc -l <"$sequence/times.txt")"
check "headers with the metre and its uncertainty" \
  "$(grep -a -l 'metre (scale from camera_height=1.65, +- [0-9.]* %)' height/trajectory_tum.txt height/edges.ply height/edges.bt height/edges.ot height/grid.yaml | wc -l)" -eq 5
check "report.html: the deviation, how it was found, and its course" \
  "$(grep -o -e '% (one standard deviation), median' -e 'measured from edges on the ground' -e 'metres per unit' height/report.html | sort -u | wc -l)" -eq 3
run_code 0 "$edgevo" run "$sequence" -o height2 --scale camera_height=1.65 --quiet
for file in trajectory_tum.txt trajectory_live_tum.txt scale.csv edges.ply edges.ot grid.pgm; do same "$file again" height/$file height2/$file; done

# Maps rebuilt without the odometry.
run_code 0 "$edgevo" map height -o fine --resolution 0.1
run_code 0 "$edgevo" map height -o coarse --resolution 0.4
for folder in fine coarse; do
  for file in edges.bt edges.ot grid.yaml grid.pgm grid.gridmap.gz; do [ -s $folder/$file ] || fail "$folder/$file"; done
done
check "resolution of the fine octree" "$(grep -a -m1 '^res ' fine/edges.bt | grep -c 'res 0.1$')" -eq 1
check "resolution of the coarse grid" "$(grep -c '^resolution: 0.4' coarse/grid.yaml)" -eq 1
check "trinary grid" "$(grep -c -e '^mode: trinary' -e '^negate: 0' -e '^occupied_thresh: 0.65' -e '^free_thresh: 0.196' coarse/grid.yaml)" -eq 4
check "gray values of the grid: occupied, unknown, free" "$(tail -c +200 coarse/grid.pgm | od -An -v -tu1 -w1 | sort -u | tr -d ' \n')" -eq 0205254

# Invalid and missing sources of scale.
complains "did you mean odometry" "$edgevo" run "$sequence" -o out --scale odometer
complains "goes with no other source" "$edgevo" run "$sequence" -o out --scale gps,factor=2
complains "names a source twice: gps" "$edgevo" run "$sequence" -o out --scale gps,gps
complains "takes no value" "$edgevo" run "$sequence" -o out --scale gps=1
complains "camera_height=1.65" "$edgevo" run "$sequence" -o out --scale camera_height
complains "not a positive number" "$edgevo" run "$sequence" -o out --scale camera_height=-2
complains "recorded no odometry" "$edgevo" run "$sequence" -o out --scale odometry
complains "recorded no GPS" "$edgevo" run street.rawlog -o out --scale gps
check "folders left by these" "$(ls -d out 2>/dev/null | wc -l)" -eq 0
complains "arbitrary unit.*no ground" "$edgevo" run "$scenes/desk" -o desk --scale camera_height=0.5 --quiet
check "and the results are there" "$(poses desk)" -gt 30
check "results marked as arbitrary" "$(grep -c 'arbitrary' desk/trajectory_tum.txt)" -eq 1
complains "resolution" "$edgevo" map height -o out --resolution 0
complains "edges.ply: cannot be read" "$edgevo" map nowhere -o out
mkdir broken
head -c 20000 height/edges.ply >broken/edges.ply
complains "truncated" "$edgevo" map broken -o out
echo "ply" >broken/edges.ply
complains "is not a PLY file of edgevo" "$edgevo" map broken -o out
finish
