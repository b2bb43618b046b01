#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Help, version, manual pages and bash completion list the same sub-commands and options.
. "$(dirname "$0")/cli_common.sh"
manuals=$(cd "$(dirname "$edgevo")/.." && pwd)/manuals

"$edgevo" --help >main.txt
commands=$(sed -n '/^Subcommands:/,$s/^  \([a-z]\{1,\}\) .*/\1/p' main.txt)
check "sub-commands" "$(echo "$commands" | wc -l)" -ge 12
run_code 0 "$edgevo" help
same "edgevo help" main.txt stdout
"$edgevo" run --help >run.txt
run_code 0 "$edgevo" help run
same "edgevo help run" run.txt stdout
complains "unknown sub-command 'rum'; did you mean run" "$edgevo" help rum

# The program that users call prints stored texts, which must be those of the program behind it.
commands_program=$(dirname "$edgevo")/edgevo-commands
"$commands_program" --help >main_there.txt
same "help of the program and of the one behind it" main_there.txt main.txt
"$commands_program" run --help >run_there.txt
same "the same for a sub-command" run_there.txt run.txt
run_code 0 "$edgevo" simulate street --frames 0:1 --help
"$edgevo" simulate -h >simulate.txt
same "help among other words" simulate.txt stdout
check "shared libraries of the program" "$(ldd "$edgevo" | wc -l)" -le 15

run_code 0 "$edgevo" help parameters
check "the basic parameters" "$(grep -c '^  edges.canny_percentile: 0.9    \[0.5, 0.99\]$\|^basic: ' stdout)" -eq 2
check "none of another level" "$(grep -c '^  association\|^advanced: ' stdout)" -eq 0
run_code 0 "$edgevo" help parameters --all
check "all parameters, by level" "$(grep -c '^  edges.detector: canny\|^  association.k_p: 1 \|^advanced: ' stdout)" -eq 3
complains "edgevo help parameters: unknown argument '--al'; give --all or nothing" "$edgevo" help parameters --al

run_code 0 "$edgevo" --version
check "version and commit" "$(grep -c '^edgevo [0-9.]*$\|^commit [0-9a-f]\{7,\}.*, \|^commit unknown, ' stdout)" -eq 2
check "versions of the libraries" "$(grep -c 'MRPT [0-9.]*, OpenCV [0-9.]*, Ceres [0-9.]*, OctoMap [0-9.]*, Eigen [0-9.]*$' stdout)" -eq 1

[ -d "$manuals" ] || skip "manual pages and completion: built without help2man"
# completed WORD...: what bash offers for the last word, sorted, one a line.
completed() {
  bash -c '. "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _edgevo; printf "%s\n" "${COMPREPLY[@]}"' \
    "$manuals/completions/edgevo" "$@" | sort
}
completed edgevo '' | grep -v '^--' >offered.txt
echo "$commands" | sort >expected.txt
same "bash offers the sub-commands" expected.txt offered.txt
completed edgevo help si >offered.txt
check "bash offers 'help simulate'" "$(cat offered.txt)" = simulate
for name in $commands; do
  [ "$name" != help ] || continue
  "$edgevo" "$name" --help >help.txt 2>&1 || continue  # servo, in a build without ViSP
  sed -n 's/^  \(-[^ ]*\).*/\1/p' help.txt | tr , '\n' | grep '^--' | sort >expected.txt
  completed edgevo "$name" -- >offered.txt
  same "bash offers the $(wc -l <expected.txt) options of $name" expected.txt offered.txt
  zcat "$manuals/man1/edgevo-$name.1.gz" | sed 's/\\-/-/g; s/\\fB//g; s/\\fR//g' >page.txt
  while read -r option; do grep -q -e "$option" page.txt || fail "$option is not on the manual page of $name"; done <expected.txt
done
ok "the manual pages have all options"
zcat "$manuals/man1/edgevo.1.gz" >page.txt
check "manual page of edgevo" "$(grep -c '^monocular\|^edgevo - \|^edgevo \\- ' page.txt)" -ge 1
finish
