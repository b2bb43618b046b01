# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the cli_*.sh tests: POSIX sh, no python. Each is called as
#   cli_X.sh EDGEVO SCENES
# with the program and the folder of the rendered sequences (cli_render.sh), works in a temporary folder, prints one line per
# check and exits with 0 if all pass, or 77 (ctest: skipped) if it cannot test on this machine.
set -u
export LC_ALL=C
edgevo=$(realpath -m "${1:?usage: $0 EDGEVO SCENES}")
scenes=$(realpath -m "${2:?usage: $0 EDGEVO SCENES}")
here=$(realpath "$(dirname "$0")")
work=$(mktemp -d)
cleanup() { :; }
trap 'cleanup; rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
cd "$work" || exit 1
failures=0
failed=

ok() { echo "ok    $1"; }
fail() {
  echo "FAIL  $1"
  failures=$((failures + 1))
  failed="$failed
FAIL  $(echo "$1" | head -1)"
}
finish() {
  [ "$failures" -eq 0 ] || { echo "$failures check(s) failed:$failed" >&2; exit 1; }
  exit 0
}
skip() {
  echo "SKIPPED, NOT TESTED: $1"
  exit 77
}

# check WHAT A OPERATOR B: integers, by test(1).
check() {
  if [ -n "$2" ] && [ -n "$4" ] && [ "$2" "$3" "$4" ]; then ok "$1: $2 ($3 $4)"; else fail "$1: got '$2', expected $3 '$4'"; fi
}
# below WHAT A B: decimal numbers, A < B.
below() {
  if [ -n "$2" ] && awk -v a="$2" -v b="$3" 'BEGIN { exit !(a + 0 < b + 0) }'; then ok "$1: $2 (< $3)"; else fail "$1: got '$2', expected less than $3"; fi
}
# eventually COMMAND...: waits until the command succeeds, a minute at most.
eventually() {
  for try in $(seq 600); do
    "$@" && return 0
    sleep 0.1
  done
  return 1
}
# run_code CODE COMMAND...: the exit code, with stdout in ./stdout and stderr in ./stderr.
run_code() {
  expected=$1
  shift
  code=0
  "$@" >stdout 2>stderr </dev/null || code=$?
  if [ "$code" -eq "$expected" ]; then
    ok "exit code $code of $(words "$@")"
  else
    fail "exit code $code, expected $expected, of $(words "$@"): $(head -c 400 stderr)"
  fi
}
words() {
  echo "$*" | sed "s|$edgevo|edgevo|; s|$scenes|SCENES|g; s|$work|.|g" | cut -c1-110
}
# complains WORDS COMMAND...: exit code 2 and one single line on stderr that holds WORDS (a basic regular expression).
complains() {
  pattern=$1
  shift
  run_code 2 "$@"
  check "lines on stderr" "$(wc -l <stderr)" -eq 1
  if grep -q -e "$pattern" stderr; then ok "  $(cut -c1-150 stderr)"; else fail "no '$pattern' in: $(cat stderr)"; fi
  # An expected error says where, what and what to do; a stray exception of a library does not.
  if grep -q '^edgevo: .*[;?]' stderr; then :; else fail "no remedy in: $(cat stderr)"; fi
}
same() {
  if cmp -s "$2" "$3"; then ok "$1: same bytes"; else fail "$1: $2 and $3 differ"; fi
}
differ() {
  if cmp -s "$2" "$3"; then fail "$1: $2 and $3 are the same"; else ok "$1: differ"; fi
}
poses() { grep -c '^[0-9]' "$1/trajectory_tum.txt"; }
rows() { awk 'END { print NR - 1 }' "$1/frames.csv"; }
# in_state OUT STATE [FIRST LAST]: number of rows (of frames FIRST to LAST) in that state.
in_state() { awk -F, -v s="$2" -v a="${3:-0}" -v b="${4:-999999999}" 'NR > 1 && $1 >= a && $1 <= b && $3 == s' "$1/frames.csv" | wc -l; }
# untimed OUT: frames.csv without the latency and the columns of times, which come last.
untimed() { cut -d, -f1-10,12-52 "$1/frames.csv" >"$1/frames_untimed.csv"; }
# ate OUT SEQUENCE: RMSE in metres after a Sim(3) alignment.
ate() {
  "$edgevo" eval "$1/trajectory_tum.txt" "$2/groundtruth_tum.txt" --json >eval.json 2>eval.err
  sed -n '/"ate_sim3"/,/}/s/.*"rmse_m": *\([0-9.e+-]*\).*/\1/p' eval.json
}
# results_kept OUT FRAMES: the run ended early, but all results exist for that many frames.
results_kept() {
  check "rows of frames.csv up to there" "$(rows "$1")" -eq "$2"
  for file in trajectory_tum.txt trajectory_live_tum.txt edges.ply edge_segments.csv edges.bt edges.ot edges_color.ot keyframes.simplemap playback.rawlog summary.yaml; do
    [ -s "$1/$file" ] || fail "$file is not there or empty"
  done
  check "poses up to there" "$(poses "$1")" -ge $(($2 - 10))
  check "summary.yaml says that it was interrupted" "$(grep -c 'interrupted: true' "$1/summary.yaml")" -eq 1
}
# copy_sequence FROM TO [A B]: a copy whose images are hard or symbolic links (frames A to B-1), to be damaged.
copy_sequence() {
  from=$1 to=$2 begin=${3:-0} end=${4:-999999}
  mkdir -p "$to/images"
  cp "$from/camera.txt" "$to"
  [ ! -f "$from/groundtruth_tum.txt" ] || cp "$from/groundtruth_tum.txt" "$to"
  awk -v a="$begin" -v b="$end" 'NR > a && NR <= b' "$from/times.txt" >"$to/times.txt"
  for name in $(ls "$from/images" | awk -v a="$begin" -v b="$end" 'NR > a && NR <= b'); do
    ln -s "$from/images/$name" "$to/images/$name"
  done
}
# plain_image WIDTH HEIGHT FILE.pgm: black.
plain_image() {
  printf 'P5\n%d %d\n255\n' "$1" "$2" >"$3"
  head -c $(($1 * $2)) /dev/zero >>"$3"
}
# start_display: starts an X server of our own and sets DISPLAY.
start_display() {
  command -v Xvfb >/dev/null && command -v xdotool >/dev/null || { fail "Xvfb or xdotool is missing; share/install_dependencies.sh"; finish; }
  Xvfb -displayfd 1 -noreset -nolisten tcp -screen 0 1280x1000x24 >display 2>xvfb.log &
  xvfb=$!
  cleanup() { kill $xvfb 2>/dev/null; }
  eventually [ -s display ] || { fail "Xvfb does not start: $(tail -1 xvfb.log)"; finish; }
  DISPLAY=:$(cat display) LIBGL_ALWAYS_SOFTWARE=1 GDK_BACKEND=x11
  export DISPLAY LIBGL_ALWAYS_SOFTWARE GDK_BACKEND
}
# window NAME: waits for a window whose title matches that regular expression and sets $window.
find_window() {
  window=$(xdotool search --name "$1" 2>/dev/null | tail -1)
  [ -n "$window" ]
}
window() {
  eventually find_window "$1" && return
  fail "no window '$1'; there are: $(xdotool search --name . getwindowname %@ 2>/dev/null | sort -u | tr '\n' '|')"
  return 1
}
# coloured FILE [GEOMETRY]: number of pixels with a strong colour in a screenshot (or in its part WxH+X+Y).
coloured() {
  convert-im6.q16 "$1" ${2:+-crop "$2" +repage} -colorspace HSL -channel G -separate +channel -threshold 60% -format '%[fx:round(mean*w*h)]' info:
}
