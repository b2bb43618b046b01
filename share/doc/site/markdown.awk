# SPDX-License-Identifier: BSD-3-Clause
# Doxygen's filter for our Markdown pages, which are written for readers of the repository. It makes their links hold in the site:
#  - a heading gets a label of its page and its text, so that page.md#heading can be resolved;
#  - a link to a page of the site, to a heading of one, or to a public header becomes a reference, and doxygen warns where there is none;
#  - a link to any other file of the repository becomes its text: that file is not in the site.
# Lines stay lines, so that a warning names the line of the source. Use: awk -v root=REPOSITORY -f markdown.awk FILE

# The label of a page by its path in the repository: modules/core/README.md -> modules_core.
function label_of(path) {
  sub(/\.md$/, "", path)
  sub(/(^|\/)README$/, "", path)
  gsub(/[^A-Za-z0-9]/, "_", path)
  return path == "" ? "index" : path
}

# The anchor that a heading has on the usual sites for Markdown.
function slug_of(text) {
  text = tolower(text)
  gsub(/[^a-z0-9 _-]/, "", text)
  gsub(/ /, "-", text)
  return text
}

# `target` seen from the folder `from`, without . and .. parts.
function join_path(from, target, parts, kept, n, i, count, path) {
  n = split((from == "" ? "" : from "/") target, parts, "/")
  count = 0
  for (i = 1; i <= n; ++i) {
    if (parts[i] == ".." && count > 0) --count
    else if (parts[i] != "." && parts[i] != "" && parts[i] != "..") kept[++count] = parts[i]
  }
  path = ""
  for (i = 1; i <= count; ++i) path = path (i > 1 ? "/" : "") kept[i]
  return path
}

function is_page(path) {
  return path == "README.md" || path ~ /^share\/doc\/.*\.md$/ || path ~ /^modules\/[a-z_]+\/README\.md$/
}

function link(text, target, path, anchor) {
  if (target ~ /^(https?|mailto):/) return "[" text "](" target ")"
  anchor = path = target
  if (target ~ /#/) sub(/^[^#]*#/, "", anchor); else anchor = ""
  sub(/#.*/, "", path)
  path = path == "" ? page : join_path(folder, path)
  if (is_page(path) && anchor != "")
    return "[" text "](@ref " label_of(path) "__" anchor ")"
  if (is_page(path)) return "[" text "](@ref " label_of(path) ")"
  if (path ~ /^modules\/[a-z_]+\/include\/.*\.h$/) {
    sub(/^modules\/[a-z_]+\/include\//, "", path)
    return "[" text "](@ref " path ")"
  }
  return text
}

# The line with valid links and pictures; `code` stays unchanged.
function with_links(line, out, text, target, close_at) {
  out = ""
  while (match(line, /`[^`]*`|!?\[([^][`]|`[^`]*`)*\]\([^() ]+\)/)) {
    out = out substr(line, 1, RSTART - 1)
    text = substr(line, RSTART, RLENGTH)
    line = substr(line, RSTART + RLENGTH)
    if (text ~ /^`/) { out = out text; continue }
    close_at = match(text, /\]\([^()]+\)$/)
    target = substr(text, close_at + 2, length(text) - close_at - 2)
    if (text ~ /^!/) {
      sub(/.*\//, "", target)
      out = out substr(text, 1, close_at + 1) target ")"
    } else out = out link(substr(text, 2, close_at - 2), target)
  }
  return out line
}

# A link may go over the end of a line: lines wait until its text is closed.
function flush_waiting() {
  if (waiting != "") print with_links(waiting)
  waiting = ""
}

FNR == 1 {
  page = substr(FILENAME, length(root) + 2)
  folder = page
  if (!sub(/\/[^\/]*$/, "", folder)) folder = ""
  titled = in_code = 0
  waiting = ""
}
/^ *```/ { flush_waiting(); in_code = !in_code }
in_code { print; next }
/^#+ / {
  flush_waiting()
  text = $0
  sub(/^#+ +/, "", text)
  if (titled) print with_links($0) " {#" label_of(page) "__" slug_of(text) "}"
  else if (page == "README.md") print
  else print with_links($0) " {#" label_of(page) "}"
  titled = 1
  next
}
{
  text = waiting == "" ? $0 : waiting "\n" $0
  waiting = ""
  if ($0 != "" && text ~ /\[[^]]*$/) waiting = text
  else print with_links(text)
}
END { flush_waiting() }
