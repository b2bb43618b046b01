#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# cli_render.sh EDGEVO SCENES: renders the sequences that the cli_*.sh tests run on, and runs them once: the plain run with the
# default seed is in SCENES/runs/NAME, for tests that check its results or compare another run with it.
set -eu
edgevo=$1 scenes=$2
rm -rf "$scenes"
"$edgevo" simulate street --frames 0:50 -o "$scenes/street"
"$edgevo" simulate desk --frames 0:60 -o "$scenes/desk"
for name in street desk; do "$edgevo" run "$scenes/$name" -o "$scenes/runs/$name" --quiet; done
