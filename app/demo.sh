#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes a trajectory and a map from images; works from a bare clone.
#
#   app/demo.sh             renders a street scene with exact ground truth and runs on that (a minute after the build)
#   app/demo.sh SEQUENCE    runs on a dataset folder or a rawlog; for other sources call `edgevo run` (see README.md)
#
# Results are in out/demo. Exit codes are those of `edgevo run`.
set -eu
cd_from=$(pwd)
cd "$(dirname "$0")/.."
out=out/demo
edgevo=build/release/bin/edgevo

build() {
  share/install_dependencies.sh
  # Tests are configured by tests/run.sh, which also installs what they need.
  [ -e build/release/CMakeCache.txt ] && tests= || tests=-DEDGEVO_BUILD_TESTS=OFF
  mkdir -p build/release
  echo "Building (some minutes the first time; log in build/release/demo_build.log) ..."
  { share/configure.sh build/release -DCMAKE_BUILD_TYPE=Release -DEDGEVO_SANITIZE= $tests &&
    cmake --build build/release --target edgevo --parallel "${JOBS:-$(nproc)}"
  } >build/release/demo_build.log 2>&1 || {
    tail -n 40 build/release/demo_build.log >&2
    echo "demo.sh: the build failed; the whole log is build/release/demo_build.log" >&2
    exit 2
  }
}

# The sequence to run on, in $sequence.
choose_sequence() {
  if [ $# -gt 0 ]; then
    case $1 in
      /*) sequence=$1 ;;
      *) sequence=$cd_from/$1 ;;
    esac
  else
    sequence=out/demo_street
    echo "Rendering a street scene into $sequence ..."
    rm -rf "$sequence"
    "$edgevo" simulate street -o "$sequence"
  fi
}

show() {  # FILE WHAT
  [ -e "$out/$1" ] && printf '  %-34s %s\n' "$out/$1" "$2"
  return 0
}

[ $# -le 1 ] || { echo "demo.sh: give at most one sequence; see the head of this script" >&2; exit 2; }
build
choose_sequence "$@"

echo "Running the odometry on $sequence ..."
status=0
"$edgevo" run "$sequence" -o "$out" || status=$?
[ $status -eq 0 ] || [ $status -eq 3 ] || exit $status

if [ -f "$sequence/groundtruth_tum.txt" ] && [ $status -eq 0 ]; then
  echo
  "$edgevo" eval "$out/trajectory_tum.txt" "$sequence/groundtruth_tum.txt"
fi

echo
echo "Results:"
show report.html "all results on one page, for a browser"
show trajectory_tum.txt "camera poses (TUM format)"
show frames.csv "what happened in every frame"
show edges.ply "3D edges, for any point cloud viewer"
show edges.bt "OctoMap, for planners: octovis $out/edges.bt (Debian package octovis)"
show playback.rawlog "images and poses: RawLogViewer $out/playback.rawlog"
show keyframes.simplemap "keyframes: robot-map-gui $out/keyframes.simplemap"
show scene.3Dscene "3D view: SceneViewer3D $out/scene.3Dscene"
show summary.yaml "parameters, counts, timing"
exit $status
