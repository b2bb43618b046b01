// SPDX-License-Identifier: BSD-3-Clause
#include "time_unit.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "edgevo/core/error.h"
#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr TimeUnit kUnits[] = {
    {"seconds", "s", 0}, {"milliseconds", "ms", 3}, {"microseconds", "us", 6}, {"nanoseconds", "ns", 9}};
// Median step from which the unit is a finer one: 5 ms are 200 images a second, 2 ms 500, and 1 ms 1000.
constexpr double kStepFrom[] = {5, 2000, 1e6};
// Since 1970 there have been 1.8e9 s; numbers from here on are of the next unit.
constexpr double kCountFrom[] = {1e11, 1e14, 1e17};

// Numbers from here on, 2001-09, may be seconds since 1970.
constexpr double kDateFrom = 1e9;
// A usual video, frames/s.
constexpr double kSlowVideo = 5, kFastVideo = 120;
constexpr double kFastestCamera = 5000;  // frames/s

int finer_than(double value, const double (&limits)[3]) {
  return int(
      std::count_if(std::begin(limits), std::end(limits), [&](double limit) { return value >= limit; }));
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

double median_step(const std::vector<double>& times) {
  std::vector<double> steps;
  for (size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  return median(std::move(steps));
}

const std::string kSince1970 = "by their size, as a time since 1970";

std::string set_by_hand(int unit) {
  return std::string("if that is right, give --time-unit ") + kUnits[unit].symbol;
}

double in_seconds(double step, int unit) { return step * std::pow(10.0, -kUnits[unit].decimals); }

// "33 ms from image to image".
std::string steps_of(double step, int unit) {
  return short_number(1e3 * in_seconds(step, unit)) + " ms from image to image";
}

bool is_usual_video(double step_s) {
  return step_s > 0 && 1 / step_s >= kSlowVideo && 1 / step_s <= kFastVideo;
}

// The date says the unit `by_date`, the step a finer one.
UnitOfTimes contradiction(double step, int by_step, int by_date) {
  const bool video = is_usual_video(in_seconds(step, by_step));
  const int chosen = video ? by_step : by_date, other = video ? by_date : by_step;
  return {kUnits[chosen], video ? steps_of(step, by_step) : kSince1970 + (", " + steps_of(step, by_date)),
          std::string("as ") + kUnits[other].name + " they would be " +
              short_number(in_seconds(step, other)) + " s apart; " + set_by_hand(other)};
}

// Faster than usual cameras: the next coarser unit is as plausible.
std::string doubt_about_rate(double step, int unit) {
  const double rate = 1 / in_seconds(step, unit);
  if (rate <= kFastVideo) return {};
  return "these are " + short_number(rate) + " frames a second; as " + kUnits[unit - 1].name +
         " they would be " + short_number(in_seconds(step, unit - 1)) + " s apart; " + set_by_hand(unit - 1);
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

// A step like the usual one, or with a dropped image or two.
bool is_like(double step, double usual) { return step > 0.3 * usual && step < 3.5 * usual; }

// Whether times[i] goes on from the two before it only multiplied by `scale`, and the time after it from
// that.
bool goes_on(const std::vector<double>& times, size_t i, double scale) {
  const double before = times[i - 1], usual = before - times[i - 2], here = scale * times[i];
  const bool as_it_is = is_like(times[i] - before, usual);  // near zero every unit does
  if (!(usual > 0) || as_it_is || !is_like(here - before, usual)) return false;
  const double next = times[i + 1];
  return is_like(scale * next - here, usual) || is_like(next - here, usual);
}

// 0, 1, 2, ... or 1, 2, 3, ...
bool only_count(const std::vector<double>& times) {
  if (times.front() != 0 && times.front() != 1) return false;
  for (size_t i = 1; i < times.size(); ++i)
    if (times[i] != times[i - 1] + 1) return false;
  return true;
}

}  // namespace

UnitOfTimes time_unit_of(const std::vector<double>& times) {
  constexpr size_t kEnough = 3;  // one step alone may be a gap
  if (times.empty()) return {};
  const int by_date = finer_than(times.back(), kCountFrom);
  const bool is_date = times.back() >= kDateFrom;
  if (times.size() < kEnough)
    return by_date == 0 ? UnitOfTimes() : UnitOfTimes{kUnits[by_date], kSince1970, ""};
  const double step = median_step(times);
  const int by_step = finer_than(step, kStepFrom);
  if (only_count(times))
    return {
        kUnits[0], "one image a second",
        "they count 0, 1, 2, ...; if that is the number of the image, give the folder of the images itself, "
        "with --camera and --fps"};
  if (is_date && by_step > by_date) return contradiction(step, by_step, by_date);
  if (is_date && by_date > 0) return {kUnits[by_date], kSince1970 + (", " + steps_of(step, by_date)), ""};
  if (by_step == 0 && step > 0 && 1 / step > kFastestCamera)
    return {kUnits[0], steps_of(step, 0),
            "these are " + short_number(1 / step) + " frames a second; check the unit of the list"};
  if (by_step == 0) return {};
  return {kUnits[by_step], steps_of(step, by_step), doubt_about_rate(step, by_step)};
}

std::optional<OtherUnit> other_unit_in(const std::vector<double>& times) {
  for (size_t i = 2; i + 1 < times.size(); ++i)
    for (const double factor : {1e3, 1e6, 1e9})
      if (goes_on(times, i, 1 / factor) || goes_on(times, i, factor)) return OtherUnit{i, factor};
  return std::nullopt;
}

bool parse_time(const std::string& text, const TimeUnit& unit, Timestamp* t) {
  if (text.find_first_of("0123456789") == std::string::npos) return false;
  if (unit.decimals == 0) return parse_seconds(text, t);
  if (text.find_first_of("eE") == std::string::npos) return parse_seconds(shifted(text, unit.decimals), t);
  return parse_seconds(text + "e-" + std::to_string(unit.decimals), t);  // two exponents: no number
}

UnitOfTimes time_unit_given(const std::string& symbol) {
  for (const TimeUnit& unit : kUnits)
    if (symbol == unit.symbol) return {unit, "as given by --time-unit", ""};
  throw InputError("--time-unit " + symbol, "is no unit", "give s, ms, us or ns");
}

bool parse_times(const std::vector<std::string>& texts, const std::string& given,
                 std::vector<Timestamp>* times, UnitOfTimes* unit, size_t* bad) {
  std::vector<double> numbers;
  for (const std::string& text : texts) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && end == text.data() + text.size() && std::isfinite(number))
      numbers.push_back(number);
  }
  *unit = given.empty() ? time_unit_of(numbers) : time_unit_given(given);
  for (*bad = 0; *bad < texts.size(); ++*bad)
    if (!parse_time(texts[*bad], unit->unit, &times->emplace_back())) return false;
  return true;
}

}  // namespace edgevo
