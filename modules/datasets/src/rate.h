// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Times of a source that has none: a constant rate.
#include <cstdint>
#include <optional>
#include <string>

#include "edgevo/core/input_decision.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Slowest and fastest rate accepted, frames/s: beyond those of any camera; the times of a run stay finite.
constexpr double kSlowestRate = 1e-3, kFastestRate = 1e5;
/// Default rate for a source that states none, frames/s.
constexpr double kUsualRate = 30;

struct Rate {
  double fps = kUsualRate;
  /// Origin of a stated rate, for details().
  std::string says;
  /// A rate that nobody stated, for the user.
  std::optional<InputDecision> decision = {};

  Timestamp time(int64_t index) const { return Timestamp::from_seconds(double(index) / fps); }
};

/// `given` by the user if positive, else the source's `own` if that is plausible, else 30. Throws InputError
/// for an implausible `given` rate.
Rate choose_rate(double given, double own);

}  // namespace edgevo
