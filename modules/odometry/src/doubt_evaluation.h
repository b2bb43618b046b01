// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whether the map after a doubt has the unit of length of that before it.
#include <functional>
#include <optional>
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/frame_evidence.h"
#include "edgevo/odometry/health_watch.h"
#include "edgevo/odometry/mapper.h"

namespace edgevo {

/// The end of a doubt.
struct DoubtEvaluation {
  /// What mapping makes of it.
  DoubtEnded ended;
  /// The unit of length before and after; nothing if there was nothing to compare.
  std::optional<UnitComparison> unit;
};

/// Compares the map that is sure again, seen in `now`, with what it was `before` the doubt, by features that
/// both views show (mapping/view_link.h). A new map was joined to the one before by its first two views: it
/// is compared again, since its depths are better known. `scale_of`: world over map of a segment. Cost: about
/// 0.3 s.
DoubtEvaluation evaluate_doubt(const Pinhole& pinhole, const std::optional<SureView>& before,
                               const SureView& now, const std::function<double(int)>& scale_of);

/// The comparison in words, for the log.
std::string in_words(const UnitComparison& unit);

}  // namespace edgevo
