// SPDX-License-Identifier: BSD-3-Clause
#include "name_clock.h"

#include <algorithm>
#include <regex>

namespace edgevo {
namespace {

using Names = std::vector<std::string>;

constexpr int64_t kSecondsPerDay = 86400;

// Days since 1970 of a date of the Gregorian calendar: whole years that begin in March.
int64_t days_since_1970(int64_t year, int64_t month, int64_t day) {
  constexpr int64_t kMarchOfYear0 = -719468;  // days from 1970
  const int64_t y = month > 2 ? year : year - 1;
  const int64_t since_march = (153 * (month > 2 ? month - 3 : month + 9) + 2) / 5;
  return kMarchOfYear0 + 365 * y + y / 4 - y / 100 + y / 400 + since_march + day - 1;
}

// A form of clock, and which groups of the expression hold its parts; 0: none. With a date, the parts year,
// month and day are the three groups from `date` on.
struct Form {
  std::regex expression;
  int date, hours, minutes, seconds, fraction;
};

const std::vector<Form>& forms() {
  const std::string date =
      "(?:|.*[^0-9])((?:19|20)[0-9]{2})([-_.]?)(0[1-9]|1[0-2])\\2(0[1-9]|[12][0-9]|3[01])";
  const std::string zone = "(?:[+-][0-9]{2}:?[0-9]{2}|[^0-9]*)";
  static const std::vector<Form> kForms{
      // with separators
      {std::regex(date +
                  "[-_T ]*([01]?[0-9]|2[0-3])[-_:.h]([0-5][0-9])[-_:.m]([0-5][0-9])(?:[._,-]([0-9]{1,9}))?" +
                  zone),
       1, 5, 6, 7, 8},
      // without: then with a fraction, as else a counter of six digits would be one
      {std::regex(date +
                  "[-_T ]*([01][0-9]|2[0-3])([0-5][0-9])([0-5][0-9])"
                  "(?:[._,-]([0-9]{1,9})|([0-9]{3}|[0-9]{6}|[0-9]{9}))" +
                  zone),
       1, 5, 6, 7, 8},
      // no date
      {std::regex("(?:|.*[^0-9])([0-9]{1,2})[-_:h]([0-5][0-9])[-_:m]([0-5][0-9])[.,]([0-9]{1,9})"), 0, 1, 2,
       3, 4},
      {std::regex("(?:|.*[^0-9])([01][0-9]|2[0-3])([0-5][0-9])([0-5][0-9])[._,-]([0-9]{3})"), 0, 1, 2, 3, 4}};
  return kForms;
}

Timestamp time_of(const std::smatch& part, const Form& form) {
  const auto number = [&](int group) { return int64_t(std::stoll(part[size_t(group)])); };
  int64_t seconds = 3600 * number(form.hours) + 60 * number(form.minutes) + number(form.seconds);
  if (form.date > 0)
    seconds +=
        kSecondsPerDay * days_since_1970(number(form.date), number(form.date + 2), number(form.date + 3));
  std::string fraction = part[size_t(form.fraction)];
  if (fraction.empty() && part.size() > size_t(form.fraction) + 1) fraction = part[size_t(form.fraction) + 1];
  Timestamp t;
  if (!parse_seconds("0." + fraction + "0", &t)) return {};
  t.ticks += seconds * Timestamp::kTicksPerSecond;
  return t;
}

bool has_equal(std::vector<Timestamp> times) {
  std::sort(times.begin(), times.end());
  return std::adjacent_find(times.begin(), times.end()) != times.end();
}

// Two counters, "000017_001", look like a clock; but one of them stands still.
bool only_one_part_runs(const std::vector<Timestamp>& times) {
  const auto all = [&](auto&& part) {
    return std::all_of(times.begin(), times.end(),
                       [&](Timestamp t) { return part(t) == part(times.front()); });
  };
  return all([](Timestamp t) { return t.ticks % Timestamp::kTicksPerSecond; }) ||
         all([](Timestamp t) { return t.ticks / Timestamp::kTicksPerSecond; });
}

std::optional<NameClocks> clocks_of(const Names& stems, const Form& form) {
  NameClocks clocks;
  clocks.dated = form.date > 0;
  for (const std::string& stem : stems) {
    std::smatch part;
    if (!std::regex_match(stem, part, form.expression)) return std::nullopt;
    clocks.times.push_back(time_of(part, form));
  }
  if (has_equal(clocks.times)) return std::nullopt;
  return clocks;
}

}  // namespace

std::optional<NameClocks> clocks_of_names(const Names& stems) {
  const std::vector<Form>& all = forms();
  for (size_t i = 0; i < all.size(); ++i) {
    auto clocks = clocks_of(stems, all[i]);
    const bool is_bare = i % 2 == 1;  // without separators
    if (clocks && !(is_bare && only_one_part_runs(clocks->times))) return clocks;
  }
  return std::nullopt;
}

}  // namespace edgevo
