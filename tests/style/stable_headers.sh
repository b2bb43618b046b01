#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Every header listed as stable in share/doc/api.md exists; examples, tutorials and the consumer test include no others.
set -eu
cd "$(dirname "$0")/../.."
page=share/doc/api.md
stable=$(sed -n 's/^- `\(edgevo\/[a-z0-9_/]*\.h\)`.*/\1/p' "$page")
[ -n "$stable" ] || { echo "$page: no header in its list" >&2; exit 1; }
status=0
for header in $stable; do
  [ -e modules/*/include/"$header" ] || { echo "$page: $header: no such header"; status=1; }
done
included=$(grep -r -h -o -E '#include [<"]edgevo/[a-z0-9_/]+\.h' share/examples share/doc/tutorials tests/integration/consumer* |
  sed 's/.*[<"]//' | sort -u)
for header in $included; do
  printf '%s\n' "$stable" | grep -q -x -F "$header" || { echo "$header is included by an example, but not stable by $page"; status=1; }
done
exit $status
