#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Sixty-odd damaged or hostile files, over every command that reads them: images, YAML, tables, rawlogs, result folders, models;
# and absurd numbers and names. No command crashes, runs forever or changes existing files; what cannot be used gives one clear line
# and exit code 2.
. "$(dirname "$0")/cli_common.sh"
desk=$scenes/desk result=$scenes/runs/desk
limit=${EDGEVO_TEST_LIMIT:-120}  # seconds a command may take: more under a sanitizer
# sums FOLDER...: every file in them, with its size and checksum.
sums() { find "$@" -type f -print0 | sort -z | xargs -0 cksum; }
sums "$desk" "$result" >before
# A sanitizer report, or an end by a signal or a time limit, is a failure whatever else was expected.
sound() {
  if grep -q 'runtime error\|Sanitizer' stderr; then fail "sanitizer: $(grep -m 1 'runtime error\|Sanitizer' stderr)"; fi
}
# bad WORDS COMMAND...: complains within the time limit.
bad() {
  pattern=$1
  shift
  rm -rf out
  complains "$pattern" timeout "$limit" "$@"
  sound
}
# survives WHAT COMMAND...: succeeds (0), could track nothing (3), or complains as above (2).
survives() {
  what=$1 code=0
  shift
  rm -rf out
  timeout "$limit" "$@" >stdout 2>stderr </dev/null || code=$?
  case $code in
    0 | 3) ok "$what: exit code $code" ;;
    2)
      check "$what: lines on stderr" "$(wc -l <stderr)" -eq 1
      grep -q '^edgevo: .*[;?]' stderr && ok "  $(cut -c1-150 stderr)" || fail "$what: no remedy in: $(cat stderr)"
      ;;
    *) fail "$what: exit code $code: $(head -c 400 stderr)" ;;
  esac
  sound
}
# flip FILE FROM TO COUNT: inverts that many bytes, evenly spread.
flip() {
  i=0
  while [ $i -lt "$4" ]; do
    printf '\245' | dd of="$1" bs=1 seek=$(($2 + i * ($3 - $2) / $4)) conv=notrunc 2>/dev/null
    i=$((i + 1))
  done
}
size() { wc -c <"$1"; }
# sequence NAME [FRAMES]: the first frames of the desk, to be damaged.
sequence() { rm -rf "$1" && copy_sequence "$desk" "$1" 0 "${2:-6}"; }
# image NAME N: replaces the link of image N by a copy; its path is in $picture.
image() {
  picture=$1/images/$(printf %06d "$2").png
  cp --remove-destination "$desk/images/$(printf %06d "$2").png" "$picture"
}
head -c 20000 /dev/urandom >noise

# Images. In the middle of a sequence a bad one is skipped; the first has to be good.
sequence first
image first 0 && flip "$picture" 16 24 8
bad "000000.png: the image" "$edgevo" run first -o out --quiet
# An image of 30000 x 30000 pixels by its header: must not be allocated.
printf 'P5\n30000 30000\n255\n' >bomb.pgm
rm first/images/000000.png && cp bomb.pgm first/images/000000.png
bad "000000.png: the image" "$edgevo" run first -o out --quiet
sequence middle 12
image middle 2 && flip "$picture" 200 "$(size "$picture")" 20
image middle 3 && : >"$picture"
image middle 4 && cp bomb.pgm "$picture"
image middle 5 && rm "$picture" && mkdir "$picture"
image middle 6 && rm "$picture" && ln -s /dev/zero "$picture"
image middle 7 && rm "$picture" && mkfifo "$picture"
image middle 8 && rm "$picture" && ln -s "$(basename "$picture")" "$picture"
image middle 9 && plain_image 64 48 "$picture"
image middle 10 && printf 'P5\n-5 -5\n0\n' >"$picture"
survives "nine bad images of twelve" "$edgevo" run middle -o out --quiet
check "rows of them" "$(rows out)" -eq 12
survives "info --check of them" "$edgevo" info middle --check
complains "middle: [0-9]* of 12 frames cannot be used; the first: .*000002.png" "$edgevo" info middle --check
check "each is named" "$("$edgevo" info middle --check 2>/dev/null | grep -c '^BAD .*0000[01][0-9].png')" -ge 7
survives "import of them" "$edgevo" import middle middle.rawlog
survives "relight of them" "$edgevo" relight middle -o relit
survives "edges of them" "$edgevo" edges middle -o edges --detector canny --jobs 1
rm -rf middle.rawlog middle_Images relit edges
mkdir mixed && plain_image 640 480 mixed/a.pgm && plain_image 1 1 mixed/b.pgm && cp noise mixed/c.png
survives "a folder of three sizes" "$edgevo" run mixed --camera "$desk/camera.txt" --fps 10 -o out --quiet
survives "calibrate from images without a board" "$edgevo" calibrate mixed --chessboard 9x6 -o board.yaml
bad "chessboard" "$edgevo" calibrate mixed --chessboard 99999999999x6 -o board.yaml
bad "chessboard" "$edgevo" calibrate mixed --chessboard -9x-6 -o board.yaml
bad "chessboard" "$edgevo" calibrate mixed --chessboard 2000000000x2000000000 -o board.yaml
bad "dictionary" "$edgevo" calibrate mixed --charuco 7x5 --marker 0.5 --dictionary 99x99_1 -o board.yaml
bad "marker" "$edgevo" calibrate mixed --charuco 7x5 --marker nan -o board.yaml

# YAML: of parameters, cameras, lists and scenes.
yaml() {
  survives "$1 as parameters" "$edgevo" run "$desk" --frames 0:2 --params "$1" -o out --quiet
  survives "$1 as camera" "$edgevo" run "$desk" --frames 0:2 --camera "$1" -o out --quiet
  survives "$1 as list" "$edgevo" bench "$1" -o bench_out --data "$scenes"
  survives "$1 as scene" "$edgevo" simulate "$1" --frames 0:1 -o scene_out
  rm -rf bench_out scene_out
}
printf '[%.0s' $(seq 20000) >deep.yaml
yaml deep.yaml
{
  echo 'a0: &a0 [x, x, x, x, x, x, x, x, x]'
  for i in 1 2 3 4 5 6 7 8 9; do
    p=$((i - 1))
    echo "a$i: &a$i [*a$p, *a$p, *a$p, *a$p, *a$p, *a$p, *a$p, *a$p, *a$p]"
  done
} >laughs.yaml
yaml laughs.yaml
printf 'a: \000\001\377\376: [\n' >binary.yaml
yaml binary.yaml
printf 'a:\n\t- b\n' >tab.yaml
yaml tab.yaml
scene() { sed "$1" "$here/../../datasets/scenes/desk.yaml" >scene.yaml && bad "$2" "$edgevo" simulate scene.yaml --frames 0:1 -o scene_out; }
scene 's/width: 640/width: 2000000000/' "width"
scene 's/height: 480/height: -480/' "height"
scene 's/fx: 517.3/fx: .nan/' "fx"
scene 's/frames: 450/frames: 99999999999999/' "frames"
scene 's/rate_hz: 30/rate_hz: 0/' "rate_hz"
scene 's/speed: 0.3/speed: .inf/' "speed"
scene 's/kind: hand/kind: teleport/' "kind"
list() { printf "$1" >list.yaml && bad "$2" "$edgevo" bench list.yaml -o bench_out --data "$scenes"; }
list 'seeds: 1..99999999999\nsequences:\n  desk:\n    source: desk\n' "seed"
list 'seeds: 3..1\nsequences:\n  desk:\n    source: desk\n' "seed"
list 'seeds: 1\nsequences: []\n' "list.yaml"
list 'seeds: 1\nsequences:\n  ../up:\n    source: desk\n' "list.yaml"
list 'seeds: 1\nsequences:\n  desk:\n    frames: 0:5\n' "source"
rm -rf bench_out

# Tables of numbers.
truth=$desk/groundtruth_tum.txt trajectory=$result/trajectory_tum.txt
table() { bad "$1" "$edgevo" eval table.txt "$truth"; }
: >table.txt && table "table.txt"
echo "1 2 3" >table.txt && table "table.txt"
echo "1e999 0 0 0 0 0 0 1" >table.txt && table "table.txt"
echo "1 0 0 0 0 0 0 0" >table.txt && table "table.txt"
{ cat "$trajectory" && printf '5 0 0\000 0 0 0 0 1\n'; } >table.txt && table "table.txt"
sed 's/^\([0-9.]*\) .*/\1 1e300 -1e300 1e300 0 0 0 1/' "$trajectory" >table.txt
survives "positions at the limit of floating-point numbers" "$edgevo" eval table.txt "$truth"
sed 's/^\([0-9.]*\) .*/\1 0 0 0 0 0 0 1/' "$trajectory" >table.txt
survives "a trajectory without motion" "$edgevo" eval table.txt "$truth"
tr '\n' '\r' <"$trajectory" >table.txt && table "table.txt"
sed 's/$/\r/' "$trajectory" >table.txt && survives "Windows line endings" "$edgevo" eval table.txt "$truth"
awk '{ print $0; print $0 }' "$trajectory" >table.txt && survives "each line twice" "$edgevo" eval table.txt "$truth"
for total in -1 99999999999999999999 nan; do bad "frames-total" "$edgevo" eval "$trajectory" "$truth" --frames-total=$total; done
bad "a folder\|directory" "$edgevo" eval folder_is "$truth"

# Rawlogs.
"$edgevo" import "$desk" good.rawlog --frames 0:5 >/dev/null || fail "import"
n=$(size good.rawlog)
rawlog() { ln -sfn good_Images "${1%.rawlog}_Images" && survives "$1" "$edgevo" run "$1" -o out --quiet; }
head -c $((n / 2)) good.rawlog >half.rawlog && rawlog half.rawlog
head -c 100000000 /dev/zero | gzip -1 >zeros.rawlog && rawlog zeros.rawlog
gzip -c noise >packed.rawlog && rawlog packed.rawlog
for at in 20 200 700; do cp good.rawlog "flip$at.rawlog" && flip "flip$at.rawlog" $at $((at + 9)) 3 && rawlog "flip$at.rawlog"; done
gunzip -c good.rawlog 2>/dev/null >plain || cp good.rawlog plain
m=$(size plain)
for at in 5 30 90 300; do
  cp plain plain.bin && flip plain.bin $at $((m - 10)) 7 && gzip -c plain.bin >"inside$at.rawlog" && rawlog "inside$at.rawlog"
done
cp good.rawlog alone.rawlog && survives "a rawlog without its images" "$edgevo" run alone.rawlog -o out --quiet
bad "out.rawlog\|box.rawlog" sh -c "mkdir -p box.rawlog && '$edgevo' import '$desk' box.rawlog --frames 0:2"

# Folders of results.
cp -r "$result" damaged
rm -f damaged/playback_Images/*
commands_on_results() {
  survives "map: $1" "$edgevo" map damaged -o map_out
  survives "calibrate: $1" "$edgevo" calibrate damaged -o camera_out.yaml
  survives "compare: $1" "$edgevo" compare damaged -o page.html
  survives "eval: $1" "$edgevo" eval damaged/trajectory_tum.txt "$truth"
  survives "finish: $1" "$edgevo" finish damaged
  rm -rf map_out camera_out* page.html
}
restore() {
  rm -rf "damaged/$1" && cp "$result/$1" "damaged/$1"
}
head -c 5000 "$result/edges.ply" >damaged/edges.ply && cp noise damaged/summary.yaml && cp noise damaged/frames.csv
commands_on_results "torn points, noise as summary and rows"
restore edges.ply && sed -i 's/^element vertex .*/element vertex 99999999999999999/' damaged/edges.ply
: >damaged/summary.yaml && : >damaged/frames.csv && : >damaged/trajectory_tum.txt
commands_on_results "endless points, empty files"
restore edges.ply && sed -i 's/^element vertex .*/element vertex -7/; s/^element edge .*/element edge nan/' damaged/edges.ply
rm damaged/summary.yaml damaged/frames.csv damaged/trajectory_tum.txt && mkdir damaged/summary.yaml damaged/frames.csv damaged/trajectory_tum.txt
commands_on_results "values that are no numbers, folders for files"
rm -rf damaged/summary.yaml damaged/frames.csv damaged/trajectory_tum.txt
restore summary.yaml && restore frames.csv && restore trajectory_tum.txt && restore edges.ply
flip damaged/edges.ply "$(grep -abo end_header damaged/edges.ply | head -1 | cut -d: -f1)" "$(size damaged/edges.ply)" 900
sed -i 's/: [0-9][0-9.e-]*$/: 1e999/' damaged/summary.yaml && sed -i 's/,[0-9.]*,/,nan,/g' damaged/frames.csv
commands_on_results "bytes of points inverted, infinite summary"
restore edges.ply && rm damaged/summary.yaml
commands_on_results "no summary"
mkdir cut && cp noise cut/unfinished_run.bin && cp noise cut/unfinished_window.bin
bad "is incomplete" "$edgevo" finish cut
printf 'edgevo recovery log 16\n\000\377\377\377\377' >cut/unfinished_run.bin
bad "is incomplete" "$edgevo" finish cut
printf 'edgevo run journal 1\n\000\377\377\377\377' >cut/unfinished_run.bin
bad "was written by another version" "$edgevo" finish cut

# Models and edge folders.
model() { bad "$1" "$edgevo" run "$desk" -o out --quiet --frames 0:2 --detector "$2" --edge-model "$3"; }
cp noise model.onnx && model "model" network model.onnx
printf 'mean: [x\n' >model.yaml && model "model" network model.onnx
gzip -c noise >forest.yml.gz && model "forest" structured forest.yml.gz
cp noise forest.yml && model "forest" structured forest.yml
model "nothing" structured nothing
bad "edge-folder" "$edgevo" run "$desk" -o out --quiet --detector precomputed
mkdir edge_folder && cp noise edge_folder/000000.png
bad "edge_folder" "$edgevo" run "$desk" -o out --quiet --detector precomputed --edge-folder edge_folder

# Numbers, names and options against each other.
for scale in camera_height=0 camera_height=-1 camera_height=nan factor=0 factor=-2 factor=1e300 camera_height= metres; do
  bad "scale" "$edgevo" run "$desk" -o out --quiet --scale=$scale
done
for scale in 1e6 1e-6; do survives "a unit at the limit of the range" "$edgevo" run "$desk" -o out --quiet --frames 0:20 --scale=factor=$scale; done
for seed in 1e99 -3 99999999999999999999; do bad "seed" "$edgevo" run "$desk" -o out --quiet --seed=$seed; done
for fps in inf nan 1e-300 1e300; do bad "fps" "$edgevo" run "$desk/images" --camera "$desk/camera.txt" -o out --quiet --fps=$fps; done
for pace in 0 -1 nan 0x 1e999x fast; do bad "pace" "$edgevo" run "$desk" -o out --quiet --realtime --pace=$pace; done
for frames in 3:3 -1:3 a:b 0:0 : 0:5:2; do bad "frames" "$edgevo" run "$desk" -o out --quiet --frames=$frames; done
bad "fov.*camera\|camera.*fov" "$edgevo" run "$desk/images" -o out --quiet --fov 60 --camera "$desk/camera.txt"
for jobs in 0 -1 many 99999999999; do bad "jobs" "$edgevo" edges "$desk" -o out --jobs=$jobs; done
for cores in 0 -1 nan; do printf 'seeds: 1\nsequences:\n  desk:\n    source: desk\n' >list.yaml && bad "cores" "$edgevo" bench list.yaml -o out --cores=$cores; done
for resolution in 0 -1 1e-30 1e30; do bad "resolution" "$edgevo" map "$result" -o out --resolution=$resolution; done
bad "kind" "$edgevo" relight "$desk" -o out --kind rain
bad "pairs" "$edgevo" study -o out --pairs 99999999999
bad "points" "$edgevo" study -o out --points=-1
bad "noise" "$edgevo" study -o out --noise nan
bad "exposure\|rolling" "$edgevo" simulate desk --frames 0:1 -o out --exposure nan
bad "frames" "$edgevo" simulate desk --frames 0:99999999 -o out
bad "seed" "$edgevo" simulate desk --frames 0:1 --seed=-1 -o out
bad "season" "$edgevo" simulate lakeshore --frames 0:1 --season autum -o out
bad "3" "$edgevo" table 3 -o out
bad "trials" "$edgevo" table 2 --trials=-1 --data "$scenes" -o out
bad "noise" "$edgevo" table 2 --list noise -o out
bad "holds no results of a run" "$edgevo" compare "$desk" -o page.html
bad "page\|folder" sh -c "mkdir -p page_folder && '$edgevo' compare '$result' -o page_folder"
bad "noise" "$edgevo" compare "$result" --truth noise -o page.html
bad "nonsense" "$edgevo" help nonsense
bad "nowhere" "$edgevo" finish nowhere
bad "cannot be created\|cannot be written" "$edgevo" simulate desk --frames 0:1 -o /proc/nothing
bad "cannot be written\|cannot be created\|is a device" "$edgevo" compare "$result" -o /dev/full
[ ! -x "$(dirname "$edgevo")/edgevo-servo" ] || for option in --gain=nan --rate=0 --rate=1e9 --latency=nan --points=99999999999; do
  bad "${option%=*}" "$edgevo" servo -o out $option
done
bad "no folder\|is empty\|no such file" "$edgevo" run "" -o out
strange="Straße 道路 'a' \"b\" <script>alert(1)<script> \$(touch owned) %s"
copy_sequence "$desk" "$strange" 0 25
survives "a name with many special characters" "$edgevo" run "$strange" -o "out $strange" --quiet
check "script elements in its report" "$(grep -c '<script>alert' "out $strange/report.html")" -eq 0
check "files created by a name" "$(ls owned 2>/dev/null | wc -l)" -eq 0
survives "map of it" "$edgevo" map "out $strange" -o "map $strange"
survives "compare of it" "$edgevo" compare "out $strange" -o "page $(echo "$strange" | tr -d /).html"
survives "import of it" "$edgevo" import "$strange" "$(echo "$strange" | tr -d /).rawlog"

sums "$desk" "$result" >after
same "sequence and earlier run" before after
finish
