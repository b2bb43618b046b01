// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/report/page.h"

#include "assets.h"
#include "base64.h"
#include "edgevo_build_info.h"

namespace edgevo {
namespace {

// Finds the text between `open` and `close` from `*at` on and moves `*at` to its end. False: there is none.
bool between(const std::string& text, const std::string& open, const std::string& close, size_t* at,
             std::string* found) {
  const size_t begin = text.find(open, *at);
  const size_t end = begin == std::string::npos ? begin : text.find(close, begin + open.size());
  if (end == std::string::npos) return false;
  *found = text.substr(begin + open.size(), end - begin - open.size());
  *at = end;
  return true;
}

// Links to the sections that section_html() wrote into `body`.
std::string contents_of(const std::string& body) {
  std::string links, id, title;
  for (size_t at = 0;
       between(body, "<section id=\"", "\"><h2>", &at, &id) && between(body, "<h2>", "</h2>", &at, &title);)
    links += "<a href=\"#" + id + "\">" + title + "</a>\n";
  return links.empty() ? "" : "<nav class=\"contents\" aria-label=\"contents\">\n" + links + "</nav>\n";
}

}  // namespace

std::string html_escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    if (c == '&')
      html += "&amp;";
    else if (c == '<')
      html += "&lt;";
    else if (c == '>')
      html += "&gt;";
    else if (c == '"')
      html += "&quot;";
    else
      html += c;
  }
  return html;
}

std::string page_html(const std::string& title, const std::string& subtitle, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width\"><title>" +
         html_escaped(title) + "</title><style>\n" + assets::kPageCss +
         "</style></head><body><main>\n<header><h1>" + html_escaped(title) + "</h1><p>" +
         html_escaped(subtitle) + "</p></header>\n" + contents_of(body) + body + "</main>\n<script>" +
         assets::kPageJs + "</script></body></html>\n";
}

std::string section_html(const std::string& id, const std::string& title, const std::string& body) {
  return "<section id=\"" + id + "\"><h2>" + html_escaped(title) + "</h2>\n" + body + "</section>\n";
}

std::string table_html(const std::vector<std::string>& header,
                       const std::vector<std::vector<std::string>>& rows) {
  const auto row = [](const std::vector<std::string>& cells, const std::string& tag) {
    std::string html = "<tr>";
    for (const std::string& cell : cells) html += "<" + tag + ">" + html_escaped(cell) + "</" + tag + ">";
    return html + "</tr>\n";
  };
  std::string html = "<div class=\"table\"><table>" + row(header, "th");
  for (const auto& cells : rows) html += row(cells, "td");
  return html + "</table></div>\n";
}

std::string tiles_html(const std::vector<std::pair<std::string, std::string>>& tiles) {
  std::string html = "<div class=\"tiles\">\n";
  for (const auto& [value, what] : tiles)
    html += "<div><b>" + html_escaped(value) + "</b><span>" + html_escaped(what) + "</span></div>\n";
  return html + "</div>\n";
}

std::string note_html(const std::string& text) {
  return "<p class=\"note\">" + html_escaped(text) + "</p>\n";
}

std::string figure_html(const std::string& type, const std::vector<uint8_t>& bytes, const std::string& alt,
                        const std::string& caption) {
  return "<figure><img alt=\"" + html_escaped(alt) + "\" src=\"data:image/" + type + ";base64," +
         base64(bytes) + "\"><figcaption>" + html_escaped(caption) + "</figcaption></figure>\n";
}

std::string parameters_html(const std::vector<std::string>& command_line, const std::string& params_yaml,
                            const std::vector<std::pair<std::string, std::string>>& notes) {
  std::string command, text;
  for (const std::string& word : command_line) command += (command.empty() ? "" : " ") + word;
  for (const auto& [name, value] : notes) text += name + ": " + value + ". ";
  text += std::string("edgevo ") + build_info::kVersion + ", " + build_info::kGitHash + ", " +
          build_info::kBuildType + ".";
  return section_html("parameters", "Parameters",
                      "<p>Command: <code>" + html_escaped(command) +
                          "</code></p>\n<details><summary>All effective parameters</summary><pre>" +
                          html_escaped(params_yaml) + "</pre></details>\n" + note_html(text));
}

}  // namespace edgevo
