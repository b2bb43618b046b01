// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whether the map after a doubt has the unit of length of that before it.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/confidence/integrity_monitor.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/frame_evidence.h"
#include "edgevo/mapping/mapper.h"

namespace edgevo {

/// The end of a doubt.
struct DoubtEvaluation {
  /// What mapping makes of it.
  DoubtEnded ended;
  /// The unit of length before and after; nothing if there was nothing to compare.
  std::optional<RelativeScale> unit;
};

/// Standard deviation of the logarithm of a ratio of units from which on another comparison is to be made:
/// nine tenths are within 5 %.
constexpr double kUnitKnown = 0.03;

/// Compares the map that is sure again, seen in `now`, with what it was `before` the doubt, by features that
/// the newest view of before shows, too, or else one of the three before it (features/view_link.h). A new map
/// was joined to the one before by its first two views: it is compared again, since its depths are better
/// known, and takes the unit of what is no less certain than the comparison before (`known_to`, of the
/// logarithm). `scale_of`: world over map of a segment. Cost: some 0.2 s for each view of before.
DoubtEvaluation evaluate_doubt(const Pinhole& pinhole, const std::vector<TrustedReference>& before,
                               const TrustedReference& now, double known_to,
                               const std::function<double(int)>& scale_of);

/// The comparison in words, for the log.
std::string in_words(const RelativeScale& unit);

}  // namespace edgevo
