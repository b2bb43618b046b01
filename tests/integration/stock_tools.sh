#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# stock_tools.sh OUT_DIR: opens the outputs of an `edgevo run` with the tools of MRPT and OctoMap and compares what they
# find with frames.csv, trajectory_tum.txt and summary.yaml. Needs the Debian packages mrpt-apps and octomap-tools.
# Works on a copy; OUT_DIR stays as it is. Prints one line per check; exit code 0 if all pass.
set -u -o pipefail
export LC_ALL=C

out=${1:?usage: stock_tools.sh OUT_DIR}
out=$(cd "$out" && pwd) || exit 1
ini=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../share" && pwd)/observations2map_edges.ini
for tool in rawlog-edit observations2map compare_octrees bt2vrml; do
  command -v "$tool" >/dev/null || { echo "stock_tools: $tool is missing; install mrpt-apps and octomap-tools" >&2; exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$out"/playback.rawlog "$out"/keyframes.simplemap "$out"/edges.bt "$out"/edges.ot "$work" || exit 1
ln -s "$out/playback_Images" "$work/playback_Images"
cd "$work" || exit 1

failures=0
check() {  # check WHAT ACTUAL OPERATOR EXPECTED, compared as integers
  if [ -n "$2" ] && [ -n "$4" ] && [ "$2" "$3" "$4" ]; then
    echo "ok    $1: $2"
  else
    echo "FAIL  $1: got '$2', expected $3 '$4'"
    failures=$((failures + 1))
  fi
}
runs() {  # runs LOG COMMAND...: the command ends well; rawlog-edit polls the keyboard, hence /dev/null
  local log=$1
  shift
  "$@" >"$log" 2>&1 </dev/null
  check "$1 $(basename "${@: -1}"): exit code" $? -eq 0
}
summary() { sed -n "s/^  $1: *//p" "$out/summary.yaml" | head -1; }  # summary KEY, of the second level
observations() { sed -n "s|^Sensor (Label/Occurs.*: *$1 / *\([0-9]*\) /.*|\1|p" info.log; }

images_found() {
  local n=0 name
  while read -r name; do [ -s "playback_Images/${name##*/}" ] && n=$((n + 1)); done < <(sort -u out.txt)
  echo $n
}

frames=$(($(wc -l <"$out/frames.csv") - 1))
poses=$(grep -vc '^#' "$out/trajectory_tum.txt")
keyframes=$(awk -F, 'NR > 1 && $5 == 1' "$out/frames.csv" | wc -l)
points=$(($(summary points_exported) + $(summary line_vertices)))
check "frames in frames.csv" "$frames" -gt 0

# The rawlog: counts, and the poses that the stock exporter gets out of it.
runs info.log rawlog-edit --info -i playback.rawlog
check "images in the rawlog" "$(observations CAM0)" -eq "$frames"
check "poses in the rawlog" "$(observations EDGE_VO)" -eq "$poses"
check "odometry in the rawlog" "$(observations EDGE_VO_ODO)" -eq "$poses"
check "keyframe scans in the rawlog" "$(observations EDGE_VO_POINTS)" -eq "$keyframes"
runs list.log rawlog-edit --list-images -i playback.rawlog  # writes out.txt
check "images that the rawlog names and that are there" "$(images_found)" -eq "$frames"
runs export.log rawlog-edit --export-txt -i playback.rawlog
check "exported poses" "$(grep -vc '^%' playback_EDGE_VO.txt)" -eq "$poses"
check "exported odometry" "$(grep -vc '^%' playback_EDGE_VO_ODO.txt)" -eq "$poses"
check "exported poses with 28 numbers" "$(grep -v '^%' playback_EDGE_VO.txt | grep -vi nan | awk 'NF == 28' | wc -l)" -eq "$poses"
# The frame differs, but the distance from the first to the last pose is the same (the lever arm of a metric mount would change it).
if [ "$(summary metric)" = false ]; then
  distance='function d(a, b) { return sqrt((a[2]-b[2])^2 + (a[3]-b[3])^2 + (a[4]-b[4])^2) }
            /^ *[0-9]/ { n = split($0, last); if (!seen++) split($0, first) } END { print int(1000 * d(first, last) + 0.5) }'
  mm_tum=$(awk "$distance" "$out/trajectory_tum.txt")
  mm_mrpt=$(awk "$distance" playback_EDGE_VO.txt)
  check "distance of the last pose, in thousandths" "$mm_mrpt" -ge $((mm_tum - 1))
  check "distance of the last pose, in thousandths" "$mm_mrpt" -le $((mm_tum + 1))
fi

# The simplemap: every point of every keyframe arrives in a point map and marks an octomap.
runs map.log observations2map "$ini" keyframes.simplemap edges
check "keyframes in the simplemap" "$(sed -n 's/.*done: \([0-9]*\) observations.*/\1/p' map.log)" -gt 0
check "points in MRPT's point map" "$(grep -c . edges_mrpt__maps__CSimplePointsMap_01.txt)" -eq "$points"
runs mrpt_bt.log bt2vrml edges_mrpt__maps__COctoMap_00_binary.bt
check "occupied voxels in MRPT's octomap" "$(sed -n 's/.*writing \([0-9]*\) voxels.*/\1/p' mrpt_bt.log)" -gt 0

# Our own octrees.
runs compare.log compare_octrees edges.ot edges.ot
check "voxels that compare_octrees finds in edges.ot" "$(sed -n 's/^Expanded num. leafs: //p' compare.log)" -eq \
  $(($(summary voxels_occupied) + $(summary voxels_free)))
check "difference of the octree from itself (KLD 0)" "$(grep -c '^KLD: 0$' compare.log)" -eq 1
runs bt.log bt2vrml edges.bt
voxels=$(sed -n 's/.*writing \([0-9]*\) voxels.*/\1/p' bt.log)
check "occupied voxels in edges.bt" "$voxels" -gt 0
# A box may cover 8, 64, ... voxels.
check "voxels in the boxes that bt2vrml drew" "$(awk -v s="$(summary voxel_size)" \
  '/geometry Box/ { for (i = 1; i <= NF; i++) if ($i == "size") n += int($(i + 1) / s + 0.5)^3 } END { print n + 0 }' \
  edges.bt.wrl)" -eq "$(summary voxels_occupied)"

[ "$failures" -eq 0 ] || { echo "stock_tools: $failures checks failed" >&2; exit 1; }
