// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/doubt_evaluation.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/output_file.h"
#include "edgevo/features/view_link.h"

namespace edgevo {
namespace {

// Standard deviations of the link from which a unit counts as another one: one that nothing has shown to be
// wrong is kept.
constexpr double kSigmasOfKnownUnit = 2.5;

// By the newest view that links: the most certain of several links would be one whose standard deviation is
// too small.
std::optional<ViewLink> first_link(const Pinhole& pinhole, const std::vector<TrustedReference>& before,
                                   const TrustedReference& now) {
  constexpr size_t kMaxViews = 4;
  const LinkableView to(now.reference->cloud);
  for (size_t i = 0; i < std::min(before.size(), kMaxViews); ++i)
    if (const auto link = LinkableView(before[i].reference->cloud).link_to(pinhole, to)) return link;
  return std::nullopt;
}

}  // namespace

DoubtEvaluation evaluate_doubt(const Pinhole& pinhole, const std::vector<TrustedReference>& before,
                               const TrustedReference& now, double known_to,
                               const std::function<double(int)>& scale_of) {
  DoubtEvaluation found;
  DoubtEnded& ended = found.ended;
  if (before.empty() || before.front().reference == now.reference) {
    // There is nothing before the first map; and a view that is still in use is one of this map.
    ended.is_evaluated = true;
    return found;
  }
  const TrustedReference& last = before.front();
  const bool is_new_map = last.segment != now.segment;
  ended.is_evaluated = is_new_map;
  if (!is_new_map) ended.last_trusted_keyframe = last.reference->keyframe_id;
  RelativeScale& unit = found.unit.emplace();
  const std::optional<ViewLink> link = first_link(pinhole, before, now);
  if (!link) return found;
  ended.is_evaluated = true;
  unit = {link->scale * scale_of(last.segment) / scale_of(now.segment), link->sigma};
  const bool is_better = is_new_map && unit.sigma <= known_to;
  if (is_better || std::abs(std::log(unit.ratio)) > kSigmasOfKnownUnit * unit.sigma)
    ended.scale_ratio = unit.ratio;
  return found;
}

std::string in_words(const RelativeScale& unit) {
  if (!unit.is_linked()) return "nothing links the map to that before the doubt";
  return "lengths before over after the doubt: " + fixed(unit.ratio, 3) + " +- " +
         fixed(100 * unit.sigma, 1) + " %";
}

}  // namespace edgevo
