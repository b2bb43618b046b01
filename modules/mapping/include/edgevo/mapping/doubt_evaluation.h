// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whether the map after a doubt is linked to that before it, and by which unit of length.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/confidence/integrity_monitor.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/frame_evidence.h"
#include "edgevo/features/view_link.h"

namespace edgevo {

/// A view from before a doubt that is seen again.
struct LinkedView {
  /// The view.
  TrustedReference before;
  /// From it to the view after the doubt.
  ViewLink link;
};

/// What was found when a doubt ended, or later.
struct DoubtEvaluation {
  /// Whether the map counts from now on: it is a new one, or agrees with what is known of that before.
  bool confirms_map = false;
  /// Lengths before over after, each in the unit that its epoch has by what was known; nothing if there was
  /// nothing to compare.
  std::optional<RelativeScale> unit;
  /// What links the two; nothing if nothing does.
  std::optional<LinkedView> linked;
};

/// Standard deviation of the logarithm of a ratio of units from which on another comparison is to be made:
/// nine tenths are within 5 %.
constexpr double kUnitKnown = 0.03;

/// Scale of the map of a view, world over map.
using ScaleOfView = std::function<double(const TrustedReference&)>;

/// Compares the map that is sure again, seen in `now`, with what it was `before` the doubt, by features that
/// the newest view of before shows, too, or else one of the three before it (features/view_link.h). Cost:
/// some 0.2 s for each view of before.
DoubtEvaluation evaluate_doubt(const Pinhole& pinhole, const std::vector<TrustedReference>& before,
                               const TrustedReference& now, const ScaleOfView& scale_of);

/// The comparison in words, for the log.
std::string in_words(const RelativeScale& unit);

}  // namespace edgevo
