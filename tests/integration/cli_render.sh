#!/bin/sh
# cli_render.sh EDGEVO SCENES: renders the sequences that the cli_*.sh tests run on.
set -eu
edgevo=$1 scenes=$2
rm -rf "$scenes"
"$edgevo" simulate street --frames 0:50 -o "$scenes/street"
"$edgevo" simulate desk --frames 0:60 -o "$scenes/desk"
