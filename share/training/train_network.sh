#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# train_network.sh BIN OUT.onnx [SEED] [EPOCHS] [train|lasting]: makes that set with BIN/edgevo_training_set, then trains the network on it.
# Also writes OUT.yaml, which describes input and output of the network.
set -eu
[ $# -ge 2 ] || { echo "usage: train_network.sh BIN OUT.onnx [SEED] [EPOCHS] [train|lasting]" >&2; exit 2; }
python=/usr/bin/python3 # Debian's: python3-torch and python3-onnx belong to it
"$python" -c 'import torch, onnx' 2>/dev/null || { echo "train_network.sh: PyTorch is missing: apt install python3-torch python3-onnx" >&2; exit 2; }
set_file=$(mktemp)
trap 'rm -f "$set_file"' EXIT
"$1/edgevo_training_set" "$set_file" "${5:-train}" "${3:-1}"
"$python" "$(dirname "$0")/train_network.py" "$set_file" "$2" --seed "${3:-1}" --epochs "${4:-10}"
cp "$(dirname "$0")/../models/edge_network.yaml" "${2%.onnx}.yaml"  # the same for all of them
