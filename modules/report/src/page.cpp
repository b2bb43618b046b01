#include "edgevo/report/page.h"

#include "edgevo_build_info.h"

namespace edgevo {
namespace {

const char* const kStyle = R"(
:root{color-scheme:light}
body{font:15px/1.5 system-ui,sans-serif;color:#1c2330;background:#f4f5f7;margin:0}
main{max-width:1060px;margin:0 auto;padding:24px 20px 60px}
h1{font-size:24px;margin:0 0 2px}h2{font-size:18px;margin:0 0 10px}
header p{margin:0 0 18px;color:#596273;overflow-wrap:anywhere}
section{background:#fff;border:1px solid #dfe3ea;border-radius:8px;padding:16px 18px;margin:0 0 16px}
.tiles{display:grid;grid-template-columns:repeat(auto-fill,minmax(150px,1fr));gap:10px;margin:0 0 16px}
.tiles div{background:#fff;border:1px solid #dfe3ea;border-radius:8px;padding:10px 12px}
.tiles b{display:block;font-size:20px}.tiles span{color:#596273;font-size:13px}
svg{display:block;width:100%;height:auto;margin:0 0 8px;overflow:visible}
svg text{font:12px system-ui,sans-serif;fill:#596273}
.grid{stroke:#e6e9ef;fill:none}.line{fill:none;stroke-width:1.8;stroke-linejoin:round;stroke-linecap:round}
.dots{stroke:#b9bfca;stroke-width:1.7;stroke-linecap:round;fill:none}
.legend{margin:2px 0 6px;font-size:13px;color:#596273}.legend span{margin-right:14px;white-space:nowrap}
.legend i{display:inline-block;width:11px;height:11px;border-radius:3px;margin-right:5px;vertical-align:-1px}
.edges{display:grid;grid-template-columns:repeat(auto-fill,minmax(310px,1fr));gap:12px}
figure{margin:0}figure img{width:100%;height:auto;border-radius:4px;display:block}
figcaption{font-size:13px;color:#596273}
.scale{height:12px;border-radius:3px}.ends{display:flex;justify-content:space-between;font-size:13px;color:#596273;margin-bottom:10px}
code,pre{font:13px ui-monospace,monospace;background:#f4f5f7;border-radius:4px}
code{padding:1px 5px;overflow-wrap:anywhere}pre{padding:12px;overflow:auto;max-height:420px}
table{border-collapse:collapse;font-size:14px}td,th{padding:3px 14px 3px 0;text-align:right;border-bottom:1px solid #eef0f4}
td:first-child,th:first-child{text-align:left}li{margin-bottom:6px}.note{color:#596273;font-size:13px}.bad{color:#b3261e}
)";

std::string base64(const std::vector<uint8_t>& bytes) {
  static const char* const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t left = bytes.size() - i;
    const unsigned group = unsigned(bytes[i]) << 16 | unsigned(left > 1 ? bytes[i + 1] : 0) << 8 |
                           unsigned(left > 2 ? bytes[i + 2] : 0);
    text += kDigits[group >> 18];
    text += kDigits[group >> 12 & 63];
    text += left > 1 ? kDigits[group >> 6 & 63] : '=';
    text += left > 2 ? kDigits[group & 63] : '=';
  }
  return text;
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
         html_escaped(title) + "</title><style>" + kStyle + "</style></head><body><main>\n<header><h1>" +
         html_escaped(title) + "</h1><p>" + html_escaped(subtitle) + "</p></header>\n" + body +
         "</main></body></html>\n";
}

std::string section_html(const std::string& id, const std::string& title, const std::string& body) {
  return "<section id=\"" + id + "\"><h2>" + html_escaped(title) + "</h2>\n" + body + "</section>\n";
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
