#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Every kind of recording with every encoding gives the frames of the images, to the byte; and runs the same trajectories: each kind once,
# each encoding once.
#   cli_recording_table.sh EDGEVO SCENES WRITE_RECORDING COMPARE_FRAMES [SEQUENCE...]      paths from the root
# Without a SEQUENCE (a folder with images/, times.txt, camera.txt): 14 frames of a street. ALL_RUNS=1 runs every cell.
# The encodings hold the gray of the images, the coloured ones in colours that have it. A Bayer pattern cannot: it is compared with colour
# files of what it shows, interpolated by other code. 16 bits, 256 times the gray, are compared with files of 16 bits: edges are found in the
# values, without the rounding of 8 bits.
. "$(dirname "$0")/cli_common.sh"
write=${3:?usage: $0 EDGEVO SCENES WRITE_RECORDING COMPARE_FRAMES}
compare=${4:?usage: $0 EDGEVO SCENES WRITE_RECORDING COMPARE_FRAMES}
shift 4
encodings="rgb8 mono8 bgr8 rgba8 yuv422 bgra8 16UC1 bayer_rggb8"  # little for bz2, which is slow
options="--quiet --edge-map off --mcap off"

# kind KIND N: the kind that write_recording is given, in the Nth of the compressions that the kind has.
kind() {
  case $1 in
    bag) set -- "$2" bag bag-bz2 bag-lz4 ;;
    mcap) set -- "$2" mcap mcap-zstd mcap-lz4 ;;
    db3-zstd) set -- "$2" db3-zstd db3-file ;;
    *) set -- "$2" "$1" ;;
  esac
  shift $((1 + $1 % ($# - 1)))
  echo "$1"
}
# name KIND: of the file or folder.
name() {
  case $1 in
    bag*) echo x.bag ;;
    mcap-folder) echo folder ;;
    mcap*) echo x.mcap ;;
    db3-alone) echo x.db3 ;;
    *) echo folder ;;
  esac
}
# files SEQUENCE ENCODING: the folder of files that show what the encoding does.
files() {
  mkdir -p "$2/images"
  cp "$1/camera.txt" "$1/times.txt" "$2"
  "$write" "$1" images "$2" "$2/images" || fail "files of $2"
}
# reference SEQUENCE ENCODING: the folder that a recording of it is compared with.
reference() {
  case $2 in bayer* | 16UC1) echo "$2" ;; *) echo "$1" ;; esac
}
# cell SEQUENCE KIND ENCODING WITH_RUN
cell() {
  file=$(name "$2")
  rm -rf x.* folder out
  "$write" "$1" "$2" "$3" "$file" || { fail "$2 $3: not written"; return; }
  frames=$("$compare" "$file" "$(reference "$1" "$3")" 2>&1)
  check "$2 $3: equal frames" "$frames" -eq "$(grep -c '^[^#]' "$1/times.txt")"
  [ "$4" = 1 ] || return
  # shellcheck disable=SC2086
  run_code 0 "$edgevo" run "$file" -o out $options
  same "$2 $3: trajectory" out/trajectory_tum.txt "runs/$(basename "$(reference "$1" "$3")")/trajectory_tum.txt"
}
table() {
  rm -rf runs bayer_rggb8 16UC1
  files "$1" bayer_rggb8
  files "$1" 16UC1
  for source in "$1" bayer_rggb8 16UC1; do
    # shellcheck disable=SC2086
    run_code 0 "$edgevo" run "$source" -o "runs/$(basename "$source")" --mount 0,0,0 $options
    check "poses of $(basename "$source")" "$(poses "runs/$(basename "$source")")" -ge 10
  done
  row=0
  for kind in bag mcap db3 mcap-folder db3-alone db3-zstd; do
    column=0
    for encoding in $encodings; do
      to_run=${ALL_RUNS:-0}
      [ $column -ne 0 ] && [ $column -ne $((row + 1)) ] && [ "$row $column" != "0 7" ] || to_run=1
      cell "$1" "$(kind $kind $((row + column)))" "$encoding" "$to_run"
      column=$((column + 1))
    done
    row=$((row + 1))
  done
}

if [ $# -eq 0 ]; then
  copy_sequence "$scenes/street" street 0 14
  set -- street
fi
for sequence in "$@"; do
  echo "== $sequence"
  table "$sequence"
done
finish
