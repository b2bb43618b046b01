// SPDX-License-Identifier: BSD-3-Clause
#include "time_unit.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr TimeUnit kUnits[] = {{"seconds", 0}, {"milliseconds", 3}, {"microseconds", 6}, {"nanoseconds", 9}};
// Median step from which the unit is a finer one: 5 ms are 200 images a second, 2 ms 500, and 1 ms 1000.
constexpr double kStepFrom[] = {5, 2000, 1e6};
// Since 1970 there have been 1.8e9 s; numbers from here on are of the next unit.
constexpr double kCountFrom[] = {1e11, 1e14, 1e17};

int finer_than(double value, const double (&limits)[3]) {
  return int(
      std::count_if(std::begin(limits), std::end(limits), [&](double limit) { return value >= limit; }));
}

double median_step(const std::vector<double>& times) {
  std::vector<double> steps;
  for (size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  return median(std::move(steps));
}

// "12345.6" with the point three digits further left: "12.3456".
std::string shifted(const std::string& text, int digits) {
  const size_t begin = !text.empty() && text[0] == '-' ? 1 : 0;
  const size_t point = std::min(text.find('.'), text.size());
  std::string whole = text.substr(begin, point - begin);
  const std::string rest = point < text.size() ? text.substr(point + 1) : "";
  if (int(whole.size()) <= digits) whole.insert(0, size_t(digits) + 1 - whole.size(), '0');
  whole.insert(whole.size() - size_t(digits), ".");
  return text.substr(0, begin) + whole + rest;
}

}  // namespace

TimeUnit time_unit_of(const std::vector<double>& times) {
  constexpr size_t kEnough = 3;  // one step alone may be a gap
  if (times.empty()) return kUnits[0];
  const int by_step = times.size() >= kEnough ? finer_than(median_step(times), kStepFrom) : 0;
  return kUnits[std::max(by_step, finer_than(times.back(), kCountFrom))];
}

bool parse_time(const std::string& text, const TimeUnit& unit, Timestamp* t) {
  if (text.find_first_of("0123456789") == std::string::npos) return false;
  if (unit.decimals == 0) return parse_seconds(text, t);
  if (text.find_first_of("eE") == std::string::npos) return parse_seconds(shifted(text, unit.decimals), t);
  return parse_seconds(text + "e-" + std::to_string(unit.decimals), t);  // two exponents: no number
}

bool parse_times(const std::vector<std::string>& texts, std::vector<Timestamp>* times, TimeUnit* unit,
                 size_t* bad) {
  std::vector<double> numbers;
  for (const std::string& text : texts) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && end == text.data() + text.size() && std::isfinite(number))
      numbers.push_back(number);
  }
  *unit = time_unit_of(numbers);
  for (*bad = 0; *bad < texts.size(); ++*bad)
    if (!parse_time(texts[*bad], *unit, &times->emplace_back())) return false;
  return true;
}

}  // namespace edgevo
