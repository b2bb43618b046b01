// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>
#include <cstdio>

#include "edgevo/benchmark/bench_list.h"
#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr const char* kRule = "days_since ";
constexpr const char* kSeedRemedy = "write `scene_seed: 7` or `scene_seed: days_since 2026-01-01`";

bool is_leap_year(int year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); }

int days_of_month(int year, int month) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return month == 2 && is_leap_year(year) ? 29 : kDays[month - 1];
}

// Days from 1970-01-01, the first day of the system clock, to "YYYY-MM-DD"; -1: it is no date since then.
int64_t day_of(const std::string& text) {
  constexpr int kFirstYear = 1970;
  int year = 0, month = 0, day = 0, end = 0;
  const bool is_read = std::sscanf(text.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &end) == 3;
  if (!is_read || text.size() != 10 || end != 10 || year < kFirstYear) return -1;
  if (month < 1 || month > 12 || day < 1 || day > days_of_month(year, month)) return -1;
  int64_t days = day - 1;
  for (int y = kFirstYear; y < year; ++y) days += is_leap_year(y) ? 366 : 365;
  for (int m = 1; m < month; ++m) days += days_of_month(year, m);
  return days;
}

uint64_t days_since(const std::string& date, const std::string& where,
                    std::chrono::system_clock::time_point now) {
  constexpr int64_t kHoursOfDay = 24;
  const int64_t first = day_of(date);
  if (first < 0) throw InputError(where, "'" + date + "' is not a date", kSeedRemedy);
  const auto hours = std::chrono::duration_cast<std::chrono::hours>(now.time_since_epoch());
  const int64_t days = hours.count() / kHoursOfDay - first;
  if (days < 0) throw InputError(where, date + " is after today", "set the clock, or give an earlier date");
  return uint64_t(days);
}

}  // namespace

uint64_t parse_scene_seed(const std::string& text, const std::string& where,
                          std::chrono::system_clock::time_point now) {
  const std::string rule = kRule;
  if (text.compare(0, rule.size(), rule) == 0) return days_since(text.substr(rule.size()), where, now);
  uint64_t seed = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size())
    throw InputError(where, "'" + text + "' is not a seed of scenes", kSeedRemedy);
  return seed;
}

}  // namespace edgevo
