#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# edgevo eval on files that were written in another way than they are read: another clock, w first, inverse poses, millimetres. One
# hint names the option, the figures stay as they are; with the option they are right. And nothing that is printed is lost in silence.
. "$(dirname "$0")/cli_common.sh"
truth=$scenes/street/groundtruth_tum.txt est=$scenes/runs/street/trajectory_tum.txt
right=$(ate "$scenes/runs/street" "$scenes/street")

# hint WORDS FILE TRUTH OPTION...: one line with WORDS on stderr; with the options there is none, and the ATE is that of the originals.
hint() {
  pattern=$1 file=$2 with=$3
  shift 3
  run_code 0 "$edgevo" eval "$file" "$with" --json
  check "hints" "$(grep -c '^HINT: ' stderr)" -eq 1
  grep -q -e "$pattern" stderr && ok "  $(cut -c1-150 stderr)" || fail "no '$pattern' in: $(cat stderr)"
  run_code 0 "$edgevo" eval "$file" "$with" --json "$@"
  check "hints with $*" "$(grep -c '^HINT: ' stderr)" -eq 0
  now=$(sed -n '/"ate_sim3"/,/}/s/.*"rmse_m": *\([0-9.e+-]*\).*/\1/p' stdout)
  below "difference of the ATE with $*" "$(awk -v a="$now" -v b="$right" 'BEGIN { d = a - b; print d < 0 ? -d : d }')" 0.005
}
run_code 0 "$edgevo" eval "$est" "$truth"
check "hints for files as documented" "$(wc -l <stderr)" -eq 0
desk=$scenes/desk/groundtruth_tum.txt
awk '/^[0-9]/ { $1 = sprintf("%.4f", $1 + 0.5) } { print }' "$desk" >late.txt
right=$(ate "$scenes/runs/desk" "$scenes/desk")
hint "t-offset 0\.[45]" "$scenes/runs/desk/trajectory_tum.txt" late.txt --t-offset 0.5
right=$(ate "$scenes/runs/street" "$scenes/street")
awk '/^[0-9]/ { $1 = sprintf("%.4f", $1 + 1.7e9) } { print }' "$truth" >unix.txt
complains "the clocks may differ; with --t-offset 1[67][0-9.]* the paths fit" "$edgevo" eval "$est" unix.txt
run_code 0 "$edgevo" eval "$est" unix.txt --t-offset 1700000000
awk '/^[0-9]/ { print $1, $2, $3, $4, $8, $5, $6, $7; next } { print }' "$truth" >wxyz.txt
awk '/^[0-9]/ { print $1, $2, $3, $4, $8, $5, $6, $7; next } { print }' "$est" >est_wxyz.txt
hint "truth-quaternion wxyz" "$est" wxyz.txt --truth-quaternion wxyz
hint "quaternion wxyz" est_wxyz.txt "$truth" --quaternion wxyz
complains "quaternion.*wxyz" "$edgevo" eval "$est" "$truth" --quaternion wzyx
complains "has no times" "$edgevo" eval "$scenes/runs/street/trajectory_kitti.txt" "$truth" --t-offset 1
complains "t-offset: .nan. is not a number" "$edgevo" eval "$est" "$truth" --t-offset nan

# A full standard output.
if [ -w /dev/full ]; then
  for command in "eval $est $truth" "info $scenes/street" "eval $est $truth --json" "--version" "--help" "help run" "help parameters" \
    "compare $scenes/runs/street -o page.html"; do
    code=0
    "$edgevo" $command >/dev/full 2>stderr || code=$?
    check "exit code of edgevo $(words $command) into a full disk" "$code" -eq 2
    check "lines that say so" "$(grep -c '^edgevo: standard output: cannot be written' stderr)" -eq 1
  done
fi
finish
