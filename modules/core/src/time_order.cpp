// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/time_order.h"

#include <algorithm>

#include "edgevo/core/clock_shifts.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

// Differences of times within 7,000 years around 1970 do not overflow; others are no times.
constexpr int64_t kMaxTicks = int64_t(1) << 61;
// A sequence that starts at 0 and goes on in a later year: the 0 stands for no time.
constexpr int64_t kYear = int64_t(365) * 86400 * Timestamp::kTicksPerSecond;

bool is_time(Timestamp t) { return t.ticks > -kMaxTicks && t.ticks < kMaxTicks; }

std::string seconds_text(int64_t ticks) { return to_string(Timestamp{ticks}) + " s"; }

}  // namespace

CheckedTime TimeOrder::check(Timestamp stated, std::optional<Timestamp> following) {
  if (!is_time(stated)) return bad("it has no time");
  const Timestamp time{stated.ticks + shift_};
  if (!is_time(time)) return bad("it has no time");
  const bool knows_following = following && is_time(*following) && is_time({following->ticks + shift_});
  const Timestamp after{knows_following ? following->ticks + shift_ : 0};
  if (!last_) {
    if (stated.ticks == 0 && knows_following && after.ticks > kYear) return bad("it has no time (0)");
  } else if (time.ticks - last_->ticks <= bad_since_) {
    return check_late(time);
  } else if (knows_following && *last_ < after && is_far_beyond(time, after)) {
    late_.clear();
    return bad("its time " + to_string(time) + " s is after that of the next frame (" + to_string(after) +
               " s)");
  }
  late_.clear();
  last_ = time;
  bad_since_ = 0;
  return {time, {}};
}

// A time beyond that of the next frame is at fault itself, unless it is so near that the two were swapped.
bool TimeOrder::is_far_beyond(Timestamp time, Timestamp following) const {
  constexpr int64_t kFar = 4;  // steps
  return following < time && (time.ticks - last_->ticks) / kFar > following.ticks - last_->ticks;
}

CheckedTime TimeOrder::check_late(Timestamp time) {
  if (!late_.empty() && time <= late_.back()) late_.clear();
  late_.push_back(time);
  if (late_.size() == kLasting) return set_base();
  return bad("its time " + to_string(time) + " s is not after the frame before (" + to_string(*last_) +
             " s)");
}

CheckedTime TimeOrder::bad(const std::string& problem) {
  ++bad_since_;
  return {last_.value_or(Timestamp{}), problem};
}

// The first of the late frames continues the series one of its own steps after the last good frame.
CheckedTime TimeOrder::set_base() {
  const int64_t back = last_->ticks - late_.front().ticks;
  const int64_t shift = back + (late_[1].ticks - late_[0].ticks);
  last_ = Timestamp{late_.back().ticks + shift};
  bad_since_ = -1;  // this frame has a time again
  shift_ += shift;
  late_.clear();
  return bad("the clock was set back by " + seconds_text(back) + " " + std::to_string(kLasting - 1) +
             " frames before: from here on " + seconds_text(shift_) + " are added to all times");
}

Timestamp TimeOrder::require(int frame_index, Timestamp stated, std::optional<Timestamp> following,
                             const std::string& where) {
  const CheckedTime checked = check(stated, following);
  if (checked.problem.empty()) return checked.time;
  throw BadFrame(frame_index, checked.time,
                 InputError(where, checked.problem, "give each frame a time after that of the one before"),
                 BadFrame::What::kTime);
}

std::vector<int64_t> clock_shifts(const std::vector<Timestamp>& times) {
  std::vector<int64_t> shifts(times.size());
  TimeOrder order;
  for (size_t i = 0; i < times.size(); ++i) {
    const int64_t before = order.shift();
    order.check(times[i], i + 1 < times.size() ? std::make_optional(times[i + 1]) : std::nullopt);
    shifts[i] = order.shift();
    if (shifts[i] == before) continue;
    for (size_t k = 1; k < TimeOrder::kLasting && k <= i; ++k) shifts[i - k] = shifts[i];
  }
  return shifts;
}

std::vector<Timestamp> fill_missing(std::vector<Timestamp> times) {
  const auto first = std::find_if(times.begin(), times.end(), is_time);
  Timestamp last = first == times.end() ? Timestamp{} : *first;
  for (Timestamp& t : times) t = last = is_time(t) ? t : last;
  return times;
}

namespace {

std::optional<InputDecision> clock_decision(const std::vector<Timestamp>& times) {
  const std::vector<int64_t> shifts = clock_shifts(times);
  int steps = 0;
  size_t first = 0;
  for (size_t i = 1; i < times.size(); ++i)
    if (shifts[i] != shifts[i - 1] && steps++ == 0) first = i;
  if (steps == 0) return std::nullopt;
  const std::string more = steps > 1 ? " and " + std::to_string(steps - 1) + " time(s) more" : "";
  return InputDecision{"clock", "set back at frame " + std::to_string(first) + more,
                       "the times of " + std::to_string(TimeOrder::kLasting) +
                           " frames in a row are before those of earlier frames",
                       "these frames are skipped, and an offset is added to all later times (see the notes "
                       "in frames.csv); correct the times for an exact synchronisation"};
}

// A list that runs backwards: a run would skip all but one frame.
std::optional<InputDecision> backwards_decision(const std::vector<Timestamp>& times) {
  size_t falls = 0;
  for (size_t i = 1; i < times.size(); ++i) falls += times[i] < times[i - 1];
  if (times.size() < 3 || 2 * falls < times.size()) return std::nullopt;
  return InputDecision{"order", "backwards",
                       "the times of " + std::to_string(falls) + " of " + std::to_string(times.size()) +
                           " frames are before that of the frame before",
                       "frames whose time does not increase are skipped; turn the list round"};
}

std::optional<InputDecision> pause_decision(const std::vector<Timestamp>& times) {
  constexpr double kShortest_s = 1, kSteps = 10;
  std::vector<double> steps;
  for (size_t i = 1; i < times.size(); ++i) steps.push_back(seconds_between(times[i - 1], times[i]));
  if (steps.size() < 2) return std::nullopt;
  const double usual = median(steps), shortest = std::max(kShortest_s, kSteps * usual);
  const auto longest = std::max_element(steps.begin(), steps.end());
  if (*longest < shortest) return std::nullopt;
  const auto pauses = std::count_if(steps.begin(), steps.end(), [&](double s) { return s >= shortest; });
  return InputDecision{"pauses",
                       std::to_string(pauses) + "; the longest is " + fixed(*longest, 1) +
                           " s, before frame " + std::to_string(longest - steps.begin() + 1),
                       "the median step is " + fixed(usual, 3) + " s",
                       "if the camera moved meanwhile, the path goes on from a guess; run the parts on their "
                       "own (--frames) if that matters"};
}

}  // namespace

std::vector<InputDecision> time_decisions(const std::vector<Timestamp>& times) {
  std::vector<InputDecision> decisions;
  if (auto clock = clock_decision(times)) decisions.push_back(std::move(*clock));
  if (auto backwards = backwards_decision(fill_missing(times))) decisions.push_back(std::move(*backwards));
  if (auto pause = pause_decision(fill_missing(times))) decisions.push_back(std::move(*pause));
  return decisions;
}

}  // namespace edgevo
