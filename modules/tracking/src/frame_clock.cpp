// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/frame_clock.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

// Bounds of a frame's interval, in usual intervals: arrival times jitter by less, and a missing frame lies
// just outside.
constexpr double kShortest = 0.5, kLongest = 1.5;
// Seconds: frames without a time of their own follow each other by a tick.
constexpr double kNoStep = 1.5 / double(Timestamp::kTicksPerSecond);

// The interval of frames that follow each other without a gap: the median of what lies around the lower
// quartile, then around that median.
double usual_interval(const std::deque<double>& intervals) {
  constexpr int kRounds = 3;  // the median converges within two
  std::vector<double> some(intervals.begin(), intervals.end());
  double usual = quantile(some, 0.25);
  for (int round = 0; round < kRounds; ++round) {
    some.clear();
    for (const double s : intervals)
      if (s >= kShortest * usual && s <= kLongest * usual) some.push_back(s);
    usual = median(some);
  }
  return usual;
}

}  // namespace

FrameClock::Step FrameClock::tick(Timestamp time) {
  const double seconds = newest_ ? seconds_between(*newest_, time) : 0;
  newest_ = time;
  if (!(seconds > kNoStep)) return {};
  const bool few = intervals_.size() < kMinIntervals;
  const double usual = few ? seconds : usual_interval(intervals_);
  intervals_.push_back(seconds);
  if (intervals_.size() > kIntervals) intervals_.pop_front();
  const double frames = std::clamp(std::round(seconds / usual), 1.0, double(kMaxFrames));
  return {int(frames), std::clamp(seconds, kShortest * frames * usual, kLongest * frames * usual)};
}

}  // namespace edgevo
