#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The disk fills up: during a run by images (those inside a rawlog are copied for the playback), after it by maps. The trajectory,
# frames.csv and summary.yaml are written all the same. The disk is a small tmpfs, which only root can mount; rawlog-edit is in the
# Debian package mrpt-apps.
. "$(dirname "$0")/cli_common.sh"
command -v rawlog-edit >/dev/null || skip "rawlog-edit is missing; install mrpt-apps"
mkdir disk
mount -t tmpfs -o size=9m none disk 2>/dev/null || skip "no right to mount a small disk here"
cleanup() { umount "$work/disk"; }

# full COMMAND...: reports a full disk; kept OUT LEAST: the small files are complete.
full() { complains "No space left on device.*free space or give another -o" "$@"; }
kept() {
  for file in trajectory_tum.txt trajectory_live_tum.txt trajectory_kitti.txt frames.csv summary.yaml; do
    [ -s "$1/$file" ] && ok "$file kept" || fail "$file lost"
  done
  check "rows of frames.csv" "$(rows "$1")" -ge "$2"
  check "poses" "$(poses "$1")" -ge $(($2 - 2))
  check "last line of trajectory_tum.txt is whole" "$(tail -n 1 "$1/trajectory_tum.txt" | wc -w)" -eq 8
  check "files that summary.yaml names as not written" "$(grep -c '^not_written: \["' "$1/summary.yaml")" -eq 1
}

"$edgevo" import "$scenes/desk" outside.rawlog --frames 0:40 >/dev/null || fail "import"
# rawlog-edit polls the keyboard, hence /dev/null.
rawlog-edit --de-externalize -i outside.rawlog -o inside.rawlog >rawlog-edit.log 2>&1 </dev/null || fail "rawlog-edit: $(tail -n 3 rawlog-edit.log)"
full "$edgevo" run inside.rawlog -o disk/out --quiet
kept disk/out 5

# Filled by a map of the smallest voxels allowed (22 MB): the run itself succeeds.
rm -rf disk/out
full "$edgevo" run "$scenes/desk" -o disk/out --quiet --frames 0:30 --set occupancy.resolution_share=0.001
kept disk/out 30

# Full from the start: reported at once.
rm -rf disk/out
head -c 5000000 /dev/zero >disk/filler
full "$edgevo" run "$scenes/desk" -o disk/out --quiet
check "files of a run that did not start" "$(ls -A disk/out | wc -l)" -eq 0

complains "No space left on device" "$edgevo" import "$scenes/desk" disk/seq.rawlog
rm -rf disk/seq*
complains "No space left on device" "$edgevo" simulate desk -o disk/desk --frames 0:40
finish
