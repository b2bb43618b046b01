#pragma once
// The frame of a report page: one HTML file with its style and script, contents, sections, figures with their
// pictures inside. For reports of any command. It looks right in windows from 320 pixels on, in the dark and
// on paper.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace edgevo {

/// Text as it may stand in HTML, in attributes too.
std::string html_escaped(const std::string& text);
/// A whole page around `body`, with links to its sections; title and subtitle are plain text.
std::string page_html(const std::string& title, const std::string& subtitle, const std::string& body);
/// A titled part of the page; `title` is plain text, `body` HTML.
std::string section_html(const std::string& id, const std::string& title, const std::string& body);
/// A table that scrolls by itself where the window is narrow; plain text.
std::string table_html(const std::vector<std::string>& header,
                       const std::vector<std::vector<std::string>>& rows);
/// A row of figures: value and what it is, plain text.
std::string tiles_html(const std::vector<std::pair<std::string, std::string>>& tiles);
/// A small gray paragraph of plain text.
std::string note_html(const std::string& text);
/// A picture with its bytes (`type`: jpeg or png) in the page itself; a click enlarges it.
std::string figure_html(const std::string& type, const std::vector<uint8_t>& bytes, const std::string& alt,
                        const std::string& caption);
/// The section with command line, parameters (YAML, folded away), notes and the version of the program.
std::string parameters_html(const std::vector<std::string>& command_line, const std::string& params_yaml,
                            const std::vector<std::pair<std::string, std::string>>& notes);

}  // namespace edgevo
