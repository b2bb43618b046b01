#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The plug-in in MRPT's own programs: rawlog-grabber -p records a rendered sequence with poses and edges and loses no frame, however
# the recording ends; edgevo runs on the recorded rawlog; observations2map builds the edge OctoMap.
here=$(cd "$(dirname "$0")" && pwd)
share=$here/../../share
. "$here/cli_common.sh"
plugin=$(cd "$(dirname "$edgevo")/../lib" && pwd)/edgevo_mrpt_plugin.so
street=$scenes/street
frames=$(ls "$street/images" | wc -l)
for tool in rawlog-grabber rawlog-edit observations2map bt2vrml; do
  command -v $tool >/dev/null || { fail "$tool is missing; install mrpt-apps and octomap-tools"; finish; }
done
mkfifo keys

# grab INI [END...]: records until the source ends or END... returns. Leaves the output in said, $rawlog, and the counts of rawlog-edit in
# info.log.
grab() {
  ini=$1
  shift
  rm -rf edges_*
  exec 3<>keys
  # In the foreground timeout(1) forwards a signal once; otherwise to the process and to its group, and the second one kills.
  timeout --foreground 120 rawlog-grabber -p "$plugin" "$ini" <&3 >said 2>&1 &
  grabber=$!
  "$@"
  wait $grabber
  check "rawlog-grabber's exit code" $? -eq 0
  exec 3<&-
  rawlog=$(ls edges_*.rawlog)
  rawlog-edit --info -i "$rawlog" >info.log 2>&1 </dev/null
}
has_images() { [ "$(ls edges_*_Images 2>/dev/null | wc -l)" -ge "$1" ]; }
press_a_key() {
  eventually has_images 3
  echo >keys
}
# Like Ctrl-C, which background jobs of a shell ignore; timeout(1) forwards it.
terminate() {
  eventually has_images 3
  kill -TERM $grabber
}
observations() { sed -n "s|^Sensor (Label/Occurs.*: *$1 / *\([0-9]*\) /.*|\1|p" info.log; }
says() { if grep -q -e "$1" said; then ok "says: $1"; else fail "no '$1' in: $(grep -v Saved said | tail -5)"; fi; }
ini() { sed "$2" "$share/$1" >edgevo.ini; }

# A rawlog as the camera. Times, calibration and mount are kept, so that the recording runs to the same bytes.
"$edgevo" import "$street" sub/street.rawlog >/dev/null || fail "import"
ini rawlog_grabber_rawlog.ini 's|^rawlog_file = .*|rawlog_file = sub/street.rawlog|'
grab edgevo.ini
says "end of the input, after $frames frames"
says "all $frames frames are in the rawlog"
check "images" "$(observations CAM0)" -eq "$frames"
check "poses" "$(observations EDGE_VO)" -ge $((frames - 5))
check "odometry" "$(observations EDGE_VO_ODO)" -eq "$(observations EDGE_VO)"
check "scans of edge points" "$(observations EDGE_VO_POINTS)" -ge 10
check "image files" "$(ls edges_*_Images | wc -l)" -eq "$frames"
run_code 0 "$edgevo" run "$rawlog" -o again --quiet
direct=$scenes/runs/street
same "trajectory of the recording" "$direct/trajectory_tum.txt" again/trajectory_tum.txt
below "its ATE, metres" "$(ate again "$street")" 0.15
# The live recording has the poses that the run had at each frame, as MRPT's exporter writes them (x forward).
rawlog-edit --export-txt -i "$rawlog" >/dev/null 2>&1 </dev/null
# The frames of the bootstrap, which have their pose only afterwards, are not in it.
awk '!/^%/ { print $2 }' "${rawlog%.rawlog}_EDGE_VO.txt" >recorded.txt
awk '/^[0-9]/ { print $4 }' "$direct/trajectory_live_tum.txt" | tail -n "$(wc -l <recorded.txt)" >live.txt
below "difference of the recorded poses from the live ones" "$(paste live.txt recorded.txt |
  awk '{ d = $1 - $2; if (d < 0) d = -d; if (d > most) most = d; if (NF != 2) odd = 1 } END { if (NR && !odd) print most + 0 }')" 0.00002

# In the map of the run: the poses in `map` of its last ten frames are those of the run.
ini rawlog_grabber_rawlog.ini "s|^rawlog_file = .*|rawlog_file = sub/street.rawlog|; s|^sensorLabel = .*|&\nmap = $direct|"
grab edgevo.ini
says "found in the map $direct"
rawlog-edit --export-txt -i "$rawlog" >/dev/null 2>&1 </dev/null
awk '!/^%/ { print $2 }' "${rawlog%.rawlog}_EDGE_VO.txt" | tail -n 10 >recorded.txt
awk '/^[0-9]/ { print $4 }' "$direct/trajectory_tum.txt" | tail -n 10 >mapped.txt
below "difference from the map" "$(paste mapped.txt recorded.txt |
  awk '{ d = $1 - $2; if (d < 0) d = -d; if (d > most) most = d; if (NF != 2) odd = 1 } END { if (NR && !odd) print most + 0 }')" 0.1

# A folder as the camera, ended by a key while the grabber still holds observations that it would drop.
ini rawlog_grabber_folder.ini "s|^image_dir_url = .*|image_dir_url = $street/images|; s|^calibration_file = .*|calibration_file = $street/camera.txt|
  s|^GRABBER_PERIOD_MS = .*|GRABBER_PERIOD_MS = 1500|; s|^process_rate = .*|process_rate = 10|"
grab edgevo.ini press_a_key
says "observations that rawlog-grabber had left were appended"
taken=$(sed -n 's/^\[FOLDER\] \([0-9]*\) frames,.*/\1/p' said)
check "images that were taken" "$taken" -ge 2
check "images in the rawlog" "$(observations CAM0)" -eq "$taken"
check "image files" "$(ls edges_*_Images | wc -l)" -eq "$taken"

# The same, ended by a signal.
grab edgevo.ini terminate
says "\[FOLDER\] interrupted, after"
taken=$(sed -n 's/.*interrupted; all \([0-9]*\) frames are in the rawlog.*/\1/p' said)
check "images that were taken" "$taken" -ge 3
check "images in the rawlog" "$(observations CAM0)" -eq "$taken"

# A camera that stops: an image in the middle is missing.
copy_sequence "$street" stops
rm stops/images/000020.png
ini rawlog_grabber_folder.ini 's|^image_dir_url = .*|image_dir_url = stops/images|; s|^calibration_file = .*|calibration_file = stops/camera.txt|'
grab edgevo.ini
says "\[FOLDER\] grabber_type image_dir: no more images (.*), after 20 frames"
check "images in the rawlog" "$(observations CAM0)" -eq 20
run_code 0 "$edgevo" info "$rawlog" --check

# Wrong paths: one line that names the section. Wrong keys are tested in plugin_test.cpp.
refused() {
  ini "$1" "$2"
  grab edgevo.ini
  says "$3"
}
refused rawlog_grabber_folder.ini 's|^image_dir_url = .*|image_dir_url = nowhere|' "\[FOLDER\] .*camera.txt.*"
refused rawlog_grabber_folder.ini "s|^image_dir_url = .*|image_dir_url = nowhere|; s|^calibration_file = .*|calibration_file = $street/camera.txt|" \
  "\[FOLDER\] grabber_type image_dir: the camera opens, but gives no image .*; check"
refused rawlog_grabber_rawlog.ini "s|^rawlog_file = .*|rawlog_file = sub/street.rawlog|; s|^sensorLabel = .*|&\nmap = nowhere|" \
  "\[RAWLOG\] nowhere: cannot be read"
refused rawlog_grabber_rawlog.ini 's|^rawlog_file = .*|rawlog_file = nowhere.rawlog|' "\[RAWLOG\] nowhere.rawlog: no such file"
refused rawlog_grabber_camera.ini "s|^calibration_file = .*|calibration_file = $street/camera.txt|; s|^cv_camera_index = .*|cv_camera_index = 77|" \
  "\[CAMERA\] grabber_type opencv: the camera does not open"

# The edge OctoMap by a stock program. Without the plug-in this type of map is unknown.
export LD_PRELOAD="$plugin"
observations2map "$share/observations2map_edge_octomap.ini" "$direct/keyframes.simplemap" map >map.log 2>&1 </dev/null
check "observations2map's exit code" $? -eq 0
unset LD_PRELOAD
bt=$(ls map*CEdgeOctoMap*.bt)
bt2vrml "$bt" >bt.log 2>&1 || fail "bt2vrml $bt"
check "occupied voxels" "$(sed -n 's/.*writing \([0-9]*\) voxels.*/\1/p' bt.log)" -ge 500
[ -s "${bt%.bt}.ot" ] && ok ".ot next to it" || fail "no .ot"
finish
