#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# edgevo/edgevo.h stays small: it draws in at most 25 headers of edgevo, directly or through others, and none of a library but Eigen.
set -eu
cd "$(dirname "$0")/../.."
limit=25

# includes_of HEADER FORM: what it includes, one a line; FORM is "quote" for headers of edgevo, "angle" for those of libraries.
includes_of() {
  case $2 in
    quote) sed -n 's/^ *# *include *"\(edgevo\/[^"]*\)".*/\1/p' modules/*/include/"$1" ;;
    angle) sed -n 's/^ *# *include *<\(.*[/.].*\)>.*/\1/p' modules/*/include/"$1" ;;
  esac
}

drawn='' waiting=edgevo/edgevo.h
while [ -n "$waiting" ]; do
  next=''
  for header in $waiting; do
    for found in $(includes_of "$header" quote); do
      case " edgevo/edgevo.h $drawn " in *" $found "*) continue ;; esac
      drawn="$drawn $found" next="$next $found"
    done
  done
  waiting=$next
done

status=0
count=$(printf '%s\n' $drawn | wc -l)
if [ "$count" -gt $limit ]; then
  echo "edgevo/edgevo.h draws in $count headers; at most $limit. Declare types instead of including them, or split their headers:"
  printf '  %s\n' $drawn
  status=1
fi
for header in edgevo/edgevo.h $drawn; do
  for library in $(includes_of "$header" angle); do
    case $library in Eigen/*) ;; *) echo "$header: <$library>: edgevo/edgevo.h needs no library but Eigen"; status=1 ;; esac
  done
done
exit $status
