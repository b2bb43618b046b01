// SPDX-License-Identifier: BSD-3-Clause
#include "axes.h"

#include <algorithm>
#include <charconv>

#include "edgevo/core/output_file.h"
#include "edgevo/report/page.h"

namespace edgevo {

void Range::add(double v) {
  if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
}

void Range::widen(double share) {
  const double margin = span() > 0 ? share * span() : std::max(1e-3, 0.05 * std::abs(high));
  low -= margin, high += margin;
}

std::vector<double> nice_ticks(double low, double high, int count) {
  if (!(low < high) || count < 1) return {};
  const double rough = (high - low) / count, power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough * 0.999) step = factor * power;
  std::vector<double> ticks;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    ticks.push_back(k * step);
  return ticks;
}

double step_of(const std::vector<double>& ticks) { return ticks.size() > 1 ? ticks[1] - ticks[0] : 1; }

std::string svg_number(double v) { return fixed(v, 1); }

std::string tick_label(double v, double step) {
  const int decimals = std::clamp(int(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  return fixed(v, decimals);
}

std::string grid_line(double x0, double y0, double x1, double y1) {
  return "<path class=\"grid\" d=\"M" + svg_number(x0) + ' ' + svg_number(y0) + 'L' + svg_number(x1) + ' ' +
         svg_number(y1) + "\"/>\n";
}

std::string svg_open(double height, const std::string& kind, bool stretched) {
  return "<svg class=\"" + kind + "\" viewBox=\"0 0 " + svg_number(kWidth) + ' ' + svg_number(height) + "\"" +
         (stretched ? " preserveAspectRatio=\"none\"" : "") + " aria-hidden=\"true\">\n";
}

std::string x_label(double share, const std::string& text, int number) {
  return std::string("<span class=\"x") + (number % 2 == 1 ? " odd" : "") +
         "\" style=\"left:" + fixed(100 * share, 2) + "%\">" + html_escaped(text) + "</span>\n";
}

std::string y_label(double share, const std::string& text) {
  return "<span class=\"y\" style=\"top:" + fixed(100 * share, 2) + "%\">" + html_escaped(text) + "</span>\n";
}

std::string legend(const std::vector<std::pair<std::string, std::string>>& name_and_color) {
  std::string html = "<p class=\"legend\">";
  for (const auto& [name, color] : name_and_color)
    html += "<span><i style=\"background:" + color + "\"></i>" + html_escaped(name) + "</span> ";
  return html + "</p>\n";
}

std::string json_list(const std::vector<double>& values) {
  std::string text;
  for (const double v : values) {
    char number[32];
    const auto end = std::to_chars(number, number + sizeof number, v, std::chars_format::general, 6).ptr;
    text += (text.empty() ? "" : ",") + (std::isfinite(v) ? std::string(number, end) : "null");
  }
  return "[" + text + "]";
}

std::string json_text(const std::string& text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') json += '\\';
    json += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return json + '"';
}

}  // namespace edgevo
