#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# --trace: what each thread did, in a file that trace viewers open; also of a run that is interrupted, and never instead of the results.
. "$(dirname "$0")/cli_common.sh"

complains 'no/such/trace.json: cannot be written' "$edgevo" run "$scenes/desk" -o out --trace no/such/trace.json
check "folders left by it" "$(ls -d out 2>/dev/null | wc -l)" -eq 0

# whole FILE: a JSON document with as many closing braces as opening ones.
whole() {
  check "begin of $1" "$(head -c 60 "$1" | grep -c '^{"displayTimeUnit":"ms","traceEvents":\[')" -eq 1
  check "end of $1" "$(tail -n 1 "$1" | grep -c '^\]}$')" -eq 1
  check "braces of $1" "$(tr -cd '{' <"$1" | wc -c)" -eq "$(tr -cd '}' <"$1" | wc -c)"
}
lane() { grep -c "\"thread_name\",\"args\":{\"name\":\"$2\"" "$1"; }
scopes() { grep -c "\"ph\":\"X\".*\"name\":\"$2\"" "$1"; }

frames=$(wc -l <"$scenes/desk/times.txt")
run_code 0 "$edgevo" run "$scenes/desk" -o plain --quiet
run_code 0 "$edgevo" run "$scenes/desk" -o traced --quiet --trace sync.json
same "the trajectory" plain/trajectory_tum.txt traced/trajectory_tum.txt
whole sync.json
check "frames in the trace" "$(scopes sync.json frame)" -eq "$frames"
check "edges of each" "$(scopes sync.json edges)" -eq "$frames"
check "frame 7" "$(grep -c '"name":"frame".*"frame":7}' sync.json)" -eq 1

run_code 0 "$edgevo" run "$scenes/desk" -o realtime --quiet --realtime --trace realtime.json
whole realtime.json
for thread in tracking mapping reading 'lines of edges'; do
  check "lanes of $thread" "$(lane realtime.json "$thread")" -ge 1
done
check "keyframes" "$(grep -c '"name":"mapping".*"keyframe":' realtime.json)" -ge 1

# Interrupted: the trace ends with the run.
rendered() { [ "$(ls interrupted/playback_Images 2>/dev/null | wc -l)" -ge 5 ]; }
"$edgevo" run "$scenes/desk" -o interrupted --quiet --realtime --pace 5 --trace interrupted.json &
pid=$!
eventually rendered
kill -INT $pid
code=0
wait $pid || code=$?
check "exit code after Ctrl-C, with a pose or without" $code -le 3
whole interrupted.json
check "frames in the trace of the interrupted run" "$(scopes interrupted.json frame)" -ge 5
finish
