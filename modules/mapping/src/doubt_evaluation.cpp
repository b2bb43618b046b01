// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/doubt_evaluation.h"

#include <algorithm>

#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

// By the newest view that links: the most certain of several links would be one whose standard deviation is
// too small.
std::optional<LinkedView> first_link(const Pinhole& pinhole, const std::vector<TrustedReference>& before,
                                     const TrustedReference& now) {
  constexpr size_t kMaxViews = 4;
  const LinkableView to(now.reference->cloud);
  for (size_t i = 0; i < std::min(before.size(), kMaxViews); ++i)
    if (const auto link = LinkableView(before[i].reference->cloud).link_to(pinhole, to))
      return LinkedView{before[i], *link};
  return std::nullopt;
}

}  // namespace

DoubtEvaluation evaluate_doubt(const Pinhole& pinhole, const std::vector<TrustedReference>& before,
                               const TrustedReference& now, const ScaleOfView& scale_of) {
  DoubtEvaluation found;
  // There is nothing before the first map; and a view that is still in use is one of this map.
  found.confirms_map = before.empty() || before.front().reference == now.reference;
  if (found.confirms_map) return found;
  found.linked = first_link(pinhole, before, now);
  found.confirms_map = found.linked || before.front().segment != now.segment;
  found.unit.emplace();
  if (const auto& linked = found.linked)
    found.unit = {linked->link.scale * scale_of(linked->before) / scale_of(now), linked->link.sigma};
  return found;
}

std::string in_words(const RelativeScale& unit) {
  if (!unit.is_linked()) return "nothing links the map to that before the doubt";
  return "lengths before over after the doubt: " + fixed(unit.ratio, 3) + " +- " +
         fixed(100 * unit.sigma, 1) + " %";
}

}  // namespace edgevo
