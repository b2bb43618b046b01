#pragma once
// Times of a source that has none of its own: a steady rate.
#include <cstdint>
#include <string>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Frames a second: slower and faster than any camera; the times of a run stay finite.
constexpr double kSlowestRate = 1e-3, kFastestRate = 1e5;
constexpr double kUsualRate = 30;  ///< frames a second, of a source that says nothing: most cameras

struct Rate {
  double fps = kUsualRate;
  std::string says;  ///< for details(): where the rate comes from

  Timestamp time(int64_t index) const { return Timestamp::from_seconds(double(index) / fps); }
};

/// `given` by the user if positive, else the source's `own` if that is plausible, else 30. Throws InputError
/// for a rate that the user cannot mean.
Rate choose_rate(double given, double own);

}  // namespace edgevo
