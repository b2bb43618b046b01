#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# edgevo overlay and edgevo mask: bodies are pasted with the truth of where, reproducibly; a part that is fixed to the camera is
# found, shown and written; a given mask takes its edges.
. "$(dirname "$0")/cli_common.sh"

"$edgevo" simulate street --frames 0:40 -o seq >/dev/null || fail "simulate"
frames=$(ls seq/images | wc -l)

# Bodies: names, times, calibration and ground truth stay.
run_code 0 "$edgevo" overlay seq -o part --own-part gripper --seed 2
run_code 0 "$edgevo" overlay seq -o again --own-part gripper --seed 2
run_code 0 "$edgevo" overlay seq -o other --own-part gripper --seed 3
for file in times.txt camera.txt groundtruth_tum.txt; do same "$file" seq/$file part/$file; done
check "frames" "$(ls part/images | wc -l)" -eq "$frames"
image=$(ls seq/images | head -1)
same "image again" part/images/$image again/images/$image
differ "image, another seed" part/images/$image other/images/$image
[ -f part/mask.png ] || fail "mask of the part"

# A stop with a bus is that much longer, and has a mask for each frame.
run_code 0 "$edgevo" overlay seq -o bus --frames 0:20 --standing 10 --stop-at 5 --crossing 500
check "frames with the stop" "$(ls bus/images | wc -l)" -eq 30
check "poses with the stop" "$(grep -vc '^#' bus/groundtruth_tum.txt)" -ge 30
check "masks of the bus" "$(ls bus/masks | wc -l)" -gt 0
run_code 0 "$edgevo" overlay seq -o lorry --vehicle-ahead 300

# The part is found, said, shown and written; with it given, nothing needs to be found.
run_code 0 "$edgevo" run part -o found
grep -q "fixed to the camera" stderr stdout || fail "the mask is said"
grep -q 'id="mask"' found/report.html && ok "the report shows the mask" || fail "the report shows the mask"
run_code 0 "$edgevo" mask found -o mask.png
same "mask" found/mask.png mask.png
complains "exists already" "$edgevo" mask found -o mask.png
run_code 0 "$edgevo" mask found -o mask.png --force
run_code 0 "$edgevo" run part --frames 0:12 --mask part/mask.png -o given
run_code 0 "$edgevo" run seq -o without --frames 0:12
run_code 1 "$edgevo" mask without -o none.png
[ ! -e none.png ] && ok "no part, no mask" || fail "a mask without a part"
grep -q 'id="mask"' without/report.html && fail "the report shows a mask without a part"

# A map waits until a dashboard is known; the frames before get poses, too.
run_code 0 "$edgevo" overlay seq -o dash --own-part dashboard
run_code 0 "$edgevo" run dash -o early --edge-map off
check "poses of the frames before the mask" "$(grep -vc '^#' early/trajectory_tum.txt)" -eq "$frames"

# Invalid requests.
complains "did you mean gripper" "$edgevo" overlay seq -o x --own-part griper
complains "nothing to paste" "$edgevo" overlay seq -o x
for needs in "--part-share 0.3" "--stop-at 3"; do
  # shellcheck disable=SC2086
  run_code 2 "$edgevo" overlay seq -o x --vehicle-ahead 300 $needs
  check "the option that it needs" "$(grep -c 'requires' stderr)" -eq 1
done
complains "--stop-at 100: is beyond the source's 6 frames" "$edgevo" overlay seq -o beyond --frames 0:6 --standing 3 --stop-at 100
complains "give --standing" "$edgevo" overlay seq -o x --crossing 500
complains "name a folder" "$edgevo" overlay seq -o x.rawlog --own-part plain
complains "not the folder of a finished run" "$edgevo" mask seq -o x.png
complains "mask" "$edgevo" run part --mask nowhere.png -o x
finish
