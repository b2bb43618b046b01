#!/bin/sh
# Every header that share/doc/api.md calls stable exists, and examples, tutorials and the consumer of the tests include no other.
set -eu
cd "$(dirname "$0")/../.."
page=share/doc/api.md
stable=$(sed -n 's/^| `\(edgevo\/[a-z0-9_/]*\.h\)` .*/\1/p' "$page")
[ -n "$stable" ] || { echo "$page: no header in its table" >&2; exit 1; }
status=0
for header in $stable; do
  [ -e modules/*/include/"$header" ] || { echo "$page: $header: no such header"; status=1; }
done
included=$(grep -r -h -o -E '#include [<"]edgevo/[a-z0-9_/]+\.h' share/examples share/doc/tutorials tests/integration/consumer |
  sed 's/.*[<"]//' | sort -u)
for header in $included; do
  printf '%s\n' "$stable" | grep -q -x -F "$header" || { echo "$header is included by an example, but not stable by $page"; status=1; }
done
exit $status
