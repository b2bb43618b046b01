// SPDX-License-Identifier: BSD-3-Clause
#include "name_times.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <regex>

#include "name_clock.h"
#include "time_unit.h"

namespace edgevo {
namespace {

using Texts = std::vector<std::string>;

std::optional<NameTimes> clock_times(const Texts& stems) {
  constexpr double kDay = 86400, kSummerTime = 3600;  // s
  auto clocks = clocks_of_names(stems);
  if (!clocks) return std::nullopt;
  NameTimes result;
  result.times = std::move(clocks->times);
  result.period_s = clocks->dated ? kSummerTime : kDay;
  result.decision = {"times",
                     std::string(clocks->dated ? "date and clock" : "hours, minutes and seconds") +
                         " in the names of the images",
                     stems.front() + " is " + to_string(result.times.front()) + " s", ""};
  return result;
}

// ---- a number at the end of the name ----

bool has_point(const std::string& number) { return number.find('.') != std::string::npos; }

bool is_whole_name(const Texts& stems, const Texts& numbers) { return stems.front() == numbers.front(); }

// "frame_12.5" may be a version; "frame_12.500" is a time.
bool has_decimals_of_a_time(const std::string& number) {
  constexpr size_t kMilliseconds = 3;
  return has_point(number) && number.size() - number.find('.') > kMilliseconds;
}

// Symbol of the unit in which the number is a date from 2001 to 2036; empty: in none.
std::string unit_by_date(const std::string& number) {
  constexpr double kFrom = 1e9, kUntil = 2.1e9;  // seconds since 1970
  const double value = std::strtod(number.c_str(), nullptr);
  double unit = 1;
  for (const char* symbol : {"s", "ms", "us", "ns"}) {
    if (value >= kFrom * unit && value < kUntil * unit) return symbol;
    unit *= 1e3;
  }
  return {};
}

// From 16 digits on, a number that is no date of today is nanoseconds of another clock.
bool has_digits_of_nanoseconds(const std::string& number) {
  return !has_point(number) && number.size() >= 16 && number.size() <= 19 && number.front() != '0';
}

std::string doubt_about(const std::vector<Timestamp>& times, const std::string& symbol) {
  constexpr double kShortest = 1e-3, kLongest = 60;  // seconds from image to image, outside of any video
  if (times.size() < 2) return {};
  const double step = seconds_between(times.front(), times.back()) / double(times.size() - 1);
  if (step >= kShortest && step <= kLongest) return {};
  char text[160];
  std::snprintf(text, sizeof text,
                "the images are %.3g s apart, which no video is; if they are not in %s, give --time-unit, or "
                "--fps if the numbers count",
                step, symbol.c_str());
  return text;
}

// Unit of all numbers; empty if they only count.
std::string unit_of(const Texts& stems, const Texts& numbers) {
  const auto all = [&](auto&& is) { return std::all_of(numbers.begin(), numbers.end(), is); };
  if (all(has_point))
    return is_whole_name(stems, numbers) || all(has_decimals_of_a_time) ? "s" : std::string();
  if (std::any_of(numbers.begin(), numbers.end(), has_point)) return {};
  const std::string unit = unit_by_date(numbers.front());
  if (!unit.empty() && unit == unit_by_date(numbers.back())) return unit;
  return all(has_digits_of_nanoseconds) ? "ns" : std::string();
}

std::optional<NameTimes> number_times(const Texts& stems, const std::string& given) {
  const Texts numbers = last_numbers(stems);
  if (numbers.empty()) return std::nullopt;
  const std::string symbol = given.empty() ? unit_of(stems, numbers) : given;
  if (symbol.empty()) return std::nullopt;
  NameTimes result;
  UnitOfTimes unit;
  size_t bad = 0;
  if (!parse_times(numbers, symbol, &result.times, &unit, &bad)) return std::nullopt;
  const bool dated = !unit_by_date(numbers.front()).empty();
  result.decision = {"times", std::string("from the names of the images, in ") + unit.unit.name,
                     !given.empty()               ? "as given by --time-unit"
                     : has_point(numbers.front()) ? "by the decimal point"
                     : dated                      ? "by their size, as a time since 1970"
                                                  : "by their number of digits",
                     given.empty() ? doubt_about(result.times, unit.unit.name) : std::string()};
  return result;
}

}  // namespace

Texts last_numbers(const Texts& stems) {
  static const std::regex kNumber("(|.*[^0-9.])([0-9]+(?:\\.[0-9]+)?)");
  Texts numbers;
  std::string beginning;
  for (const std::string& stem : stems) {
    std::smatch part;
    if (!std::regex_match(stem, part, kNumber)) return {};
    if (numbers.empty()) beginning = part[1];
    if (part[1] != beginning) return {};
    numbers.push_back(part[2]);
  }
  return numbers;
}

std::optional<NameTimes> times_of_names(const std::vector<std::string>& stems, const std::string& unit) {
  if (stems.empty()) return std::nullopt;
  if (!unit.empty()) time_unit_given(unit);  // throws if there is no such unit
  if (auto times = clock_times(stems)) return times;
  return number_times(stems, unit);
}

}  // namespace edgevo
