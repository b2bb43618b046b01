#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The runs that p_right is fitted to (share/training): made, kept by a second call, and one line where none can be made.
. "$(dirname "$0")/cli_common.sh"
command -v python3 >/dev/null || skip "python3 is missing"
corpus=$here/../../share/training/trust_corpus.py
mkdir data
ln -s "$scenes/street" data/kitti05_first300

run_code 0 python3 "$corpus" "$edgevo" data made --only 'kitti05.normal.1' 'kitti05.backward.1' --frames 20
check "runs in the list" "$(grep -c "^$work/made/kitti05\.[a-z]*\.1 /.*/groundtruth_tum.txt kitti$" made/runs.txt)" -eq 2
check "poses of the run backward" "$(poses made/kitti05.backward.1)" -ge 15
made=$(stat -c %Y made/kitti05.normal.1/summary.yaml)
run_code 0 python3 "$corpus" "$edgevo" data made --only 'kitti05.normal.1' --frames 20
check "a run that is there is kept" "$(stat -c %Y made/kitti05.normal.1/summary.yaml)" -eq "$made"

# nothing PATTERN ARGUMENTS...: one line, and no corpus.
nothing() {
  pattern=$1
  shift
  run_code 1 python3 "$corpus" "$@"
  check "lines on stderr" "$(wc -l <stderr)" -eq 1
  grep -q -e "$pattern" stderr && ok "  $(cat stderr)" || fail "no '$pattern' in: $(cat stderr)"
  [ -e none ] && fail "a folder was made" || ok "no folder"
}
nothing "is no program; build it" ./edgevo data none
nothing "is no folder; see datasets" "$edgevo" nowhere none --only 'kitti05.normal.1'
nothing "matches no run of these tiers" "$edgevo" data none --only 'kitti5.*'
nothing "need the folder of --cases" "$edgevo" data none --only 'phone.*'
finish
