#include "axes.h"

#include <algorithm>

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

std::string svg_number(double v) { return fixed(v, 1); }

std::string tick_label(double v, double step) {
  const int decimals = std::clamp(int(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  return fixed(v, decimals);
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text) {
  return "<text x=\"" + svg_number(x) + "\" y=\"" + svg_number(y) + "\" text-anchor=\"" + anchor + "\">" +
         html_escaped(text) + "</text>\n";
}

std::string grid_line(double x0, double y0, double x1, double y1) {
  return "<path class=\"grid\" d=\"M" + svg_number(x0) + ' ' + svg_number(y0) + 'L' + svg_number(x1) + ' ' +
         svg_number(y1) + "\"/>\n";
}

std::string svg_open(double height, const std::string& kind) {
  return "<svg class=\"" + kind + "\" viewBox=\"0 0 " + svg_number(kWidth) + ' ' + svg_number(height) +
         "\" role=\"img\">\n";
}

std::string legend(const std::vector<std::pair<std::string, std::string>>& name_and_color) {
  std::string html = "<p class=\"legend\">";
  for (const auto& [name, color] : name_and_color)
    html += "<span><i style=\"background:" + color + "\"></i>" + html_escaped(name) + "</span> ";
  return html + "</p>\n";
}

}  // namespace edgevo
