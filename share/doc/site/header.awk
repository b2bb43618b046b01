# SPDX-License-Identifier: BSD-3-Clause
# Doxygen's filter for our public headers. Lines stay lines, so that a warning names the line of the source.
#  - A header begins with a plain comment that says what it is for: it becomes the file's documentation. Indented lines in it, other
#    than those of lists, are tables, formulas and examples, and stay as they are.
#  - What it declares goes into the group of the module whose folder it lies in (modules.dox).
#  - One comment on `double fx, fy;  ///< pixels` applies to all names: doxygen would give it to one of them.
#  - Move constructors and assignments are skipped: they do what they do everywhere.
# Use: awk -v root=REPOSITORY -f header.awk FILE

# Splits "T a = 0, b{}" at its outer commas into piece[1..]; returns their number.
function split_names(text, i, c, depth, count) {
  count = 1
  depth = 0
  piece[1] = ""
  for (i = 1; i <= length(text); ++i) {
    c = substr(text, i, 1)
    if (c ~ /[(<{[]/) ++depth
    if (c ~ /[])}>]/) --depth
    if (c == "," && depth == 0) piece[++count] = ""
    else piece[count] = piece[count] c
  }
  return count
}

# The type of "  T name = value": all before the name.
function type_of(declaration) {
  sub(/ *(=|\{).*/, "", declaration)
  sub(/[A-Za-z_0-9]+ *$/, "", declaration)
  return declaration
}

# A declaration of several names as several declarations, each with the comment.
function spread(code, comment, count, i, type, out) {
  sub(/; *$/, "", code)
  count = split_names(code)
  type = type_of(piece[1])
  if (count < 2 || type !~ /[A-Za-z_0-9>] +$/) return ""
  out = ""
  for (i = 1; i <= count; ++i)
    out = out (i > 1 ? " " : "") "/** " comment " */ " (i > 1 ? type : "") piece[i] ";"
  return out
}

# A line of the head is printed when the next one is known: the last line of a table closes it.
function put_head(line, is_table) {
  if (is_table && !in_table) held = held " @verbatim"
  if (in_table && !is_table) held = held " @endverbatim"
  print held
  in_table = is_table
  held = line
}

FNR == 1 {
  path = substr(FILENAME, length(root) + 2)
  split(path, parts, "/")
  group = "module_" parts[2]
  name = path
  sub(/^.*\/include\//, "", name)
  in_head = in_list = in_table = 0
  held = before = ""
}
/^#pragma once/ { held = "/** @file " name; in_head = 1; next }
in_head && /^\/\// {
  if (/^\/\/ +([0-9]+\.|-) /) in_list = 1
  else if (!/^\/\/  /) in_list = 0
  is_table = /^\/\/  / && !in_list
  sub(/^\/\/ ?/, "")
  put_head($0, is_table)
  next
}
in_head { put_head("", 0); printf "*/ "; in_head = 0 }
/^namespace edgevo[a-z_:]* \{$/ { print $0 " /** @addtogroup " group " */ /** @{ */"; next }
/^}  \/\/ namespace edgevo/ { print "/** @} */ " $0; next }
/^ +[A-Za-z0-9_]+\([A-Za-z0-9_]+&&[^)]*\)|operator=\(/ { print ""; next }
/^ *\/\/\/ / {
  text = $0
  sub(/^ *\/\/\/ /, "", text)
  before = before " " text
  print
  next
}
/^  +[A-Za-z].*,.*; *(\/\/\/< .*)?$/ && !/<<|return|using|for \(/ {
  at = index($0, "///<")
  comment = at ? substr($0, at + 5) : before
  spread_out = comment == "" ? "" : spread(at ? substr($0, 1, at - 1) : $0, comment)
  before = ""
  print spread_out == "" ? $0 : spread_out
  next
}
{ before = ""; print }
