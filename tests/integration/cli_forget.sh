#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# --forget: a run that keeps nothing in memory leaves all of it on disk, and `edgevo finish` writes the same results from there.
. "$(dirname "$0")/cli_common.sh"

run_code 0 "$edgevo" run "$scenes/street" -o whole --quiet
run_code 0 "$edgevo" run "$scenes/street" -o forgotten --forget
check "the line about what is left to do" "$(grep -c 'edgevo finish forgotten. writes them' stdout)" -eq 1
check "rows written during the run" "$(rows forgotten)" -eq "$(rows whole)"
check "maps written before edgevo finish" "$(ls forgotten/edges.ply 2>/dev/null | wc -l)" -eq 0
run_code 0 "$edgevo" finish forgotten
for file in trajectory_tum.txt trajectory_live_tum.txt edges.ply edge_segments.csv edges.bt grid.pgm; do
  same "$file" whole/$file forgotten/$file
done
check "interrupted, in summary.yaml" "$(grep -c '^interrupted: true' forgotten/summary.yaml)" -eq 0
finish
