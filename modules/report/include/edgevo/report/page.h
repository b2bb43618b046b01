// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Building blocks of a report page: one HTML file with embedded style, script and pictures, a table of
// contents, sections and figures. For the reports of any command. Pages suit windows from 320 pixels on, dark
// mode and paper.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace edgevo {

/// `text` escaped for HTML, including attributes.
std::string html_escaped(const std::string& text);
/// A complete page around `body`, with links to its sections. Title and subtitle are plain text.
std::string page_html(const std::string& title, const std::string& subtitle, const std::string& body);
/// A section with a heading. `title` is plain text, `body` HTML.
std::string section_html(const std::string& id, const std::string& title, const std::string& body);
/// A table of plain text that scrolls on its own in narrow windows.
std::string table_html(const std::vector<std::string>& header,
                       const std::vector<std::vector<std::string>>& rows);
/// A row of tiles, each a value and its name; plain text.
std::string tiles_html(const std::vector<std::pair<std::string, std::string>>& tiles);
/// A small gray paragraph of plain text.
std::string note_html(const std::string& text);
/// A picture (`type`: jpeg or png) embedded in the page; a click enlarges it.
std::string figure_html(const std::string& type, const std::vector<uint8_t>& bytes, const std::string& alt,
                        const std::string& caption);
/// A section with command line, parameters (YAML, collapsed), notes and the version of the program.
std::string parameters_html(const std::vector<std::string>& command_line, const std::string& params_yaml,
                            const std::vector<std::pair<std::string, std::string>>& notes);

}  // namespace edgevo
