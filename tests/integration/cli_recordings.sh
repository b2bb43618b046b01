#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Recordings of ROS: runs equal to those of the images, choice of the topic, camera and scale from the recording, a recorder that was
# killed, import.
#   cli_recordings.sh EDGEVO SCENES WRITE_RECORDING
. "$(dirname "$0")/cli_common.sh"
write=${3:?usage: $0 EDGEVO SCENES WRITE_RECORDING}

copy_sequence "$scenes/street" street 0 14
run_code 0 "$edgevo" run street -o images --quiet --mount 0,0,0
"$write" street bag-lz4 bgr8 x.bag || fail "bag"
"$write" street mcap-zstd file x.mcap || fail "mcap"
"$write" street db3 mono8 ros2 || fail "db3"
for source in x.bag x.mcap ros2; do
  run_code 0 "$edgevo" run $source -o out_$source --quiet
  for file in trajectory_tum.txt trajectory_live_tum.txt edges.ply; do same "$source: $file" images/$file out_$source/$file; done
done

run_code 0 "$edgevo" info --check x.bag
check "kind" "$(grep -c '^kind  *ROS 1 bag$' stdout)" -eq 1
check "frames" "$(grep -c '^frames  *14$' stdout)" -eq 1
check "gaps" "$(grep -c '^gaps in time  *none$' stdout)" -eq 1
check "topics" "$(grep -c '^all topics .*/cam0/image_raw (sensor_msgs/Image, 14)' stdout)" -eq 1
check "images that decode" "$(grep -c '^check  *all 14 images decode' stdout)" -eq 1
complains "no topic '/cam1/image_raw'.*did you mean --topic /cam0/image_raw" "$edgevo" info x.bag --topic /cam1/image_raw
complains "/tf_static holds tf2_msgs/TFMessage" "$edgevo" info x.bag --topic /tf_static
complains "choose one with --topic" "$edgevo" info x.bag --sensor cam0
mkdir bags
ln x.bag bags/x.bag
complains "holds no images; give a file of it: bags/x.bag" "$edgevo" info bags
complains "is of no use: street is not a recording" "$edgevo" info street --topic /cam0/image_raw

# A recorder that was killed, and a file that was cut off: one line each, and the run goes through.
"$write" street mcap-open mono8 killed.mcap || fail "killed"
run_code 0 "$edgevo" run killed.mcap -o killed --edge-map off
check "one line says so" "$(grep -c 'recording: not closed by its recorder' stderr)" -eq 1
same "killed.mcap" images/trajectory_tum.txt killed/trajectory_tum.txt
head -c $(($(wc -c <x.bag) * 2 / 3)) x.bag >cut.bag
run_code 0 "$edgevo" info --check cut.bag
check "one line says how much is missing" "$(grep -c '^recording  *cut off: the last [0-9,]* of its [0-9,]* bytes are not a whole chunk' stdout)" -eq 1
complains "nothing whole in it\|has no whole bag header" "$edgevo" info "$(head -c 5000 x.bag >tiny.bag; echo tiny.bag)"

# Scale from the sensors of the recording, and the rawlog with them.
"$write" "$scenes/street" bag mono8 sensors.bag "$scenes/street/groundtruth_tum.txt" || fail "sensors"
run_code 0 "$edgevo" run sensors.bag -o scaled --edge-map off --scale robot_pose --quiet
run_code 0 "$edgevo" import sensors.bag -o sensors.rawlog
run_code 0 "$edgevo" info sensors.rawlog
check "sensors in the rawlog" "$(grep -c 'CObservationGPS.*CObservationOdometry.*CObservationRobotPose' stdout)" -eq 1
run_code 0 "$edgevo" run sensors.rawlog -o rawlog --edge-map off --scale robot_pose --quiet
same "the rawlog" scaled/trajectory_tum.txt rawlog/trajectory_tum.txt
finish
