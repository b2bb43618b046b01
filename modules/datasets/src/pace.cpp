// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/pace.h"

#include <charconv>
#include <sstream>

#include "edgevo/core/error.h"
#include "rate.h"

namespace edgevo {
namespace {

std::string short_number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace

double Pace::due_s(int n, Timestamp first, Timestamp time) const {
  return (kind == Kind::kRate ? n : seconds_between(first, time)) / value;
}

Pace parse_pace(const std::string& text) {
  Pace pace;
  const bool by_times = !text.empty() && text.back() == 'x';
  pace.kind = by_times ? Pace::Kind::kTimes : Pace::Kind::kRate;
  const char* const end = text.data() + text.size() - (by_times ? 1 : 0);
  const auto read = std::from_chars(text.data(), end, pace.value);
  if (read.ec != std::errc() || read.ptr != end ||
      !(pace.value >= kSlowestRate && pace.value <= kFastestRate))
    throw InputError(
        "--pace '" + text + "'", "is not a pace",
        "give frames a second such as 30, or 1x for the source's own times (0.5x: half as fast)");
  return pace;
}

std::string describe(const Pace& pace) {
  if (pace.kind == Pace::Kind::kAtOnce) return "none: each frame as soon as the one before was done";
  if (pace.kind == Pace::Kind::kRate) return short_number(pace.value) + " frames a second";
  return "the source's own times" +
         (pace.value == 1 ? "" : ", " + short_number(pace.value) + " times as fast");
}

}  // namespace edgevo
