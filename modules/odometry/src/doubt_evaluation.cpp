// SPDX-License-Identifier: BSD-3-Clause
#include "doubt_evaluation.h"

#include <cmath>

#include "edgevo/core/output_file.h"
#include "edgevo/mapping/view_link.h"

namespace edgevo {
namespace {

// Standard deviations of the link from which a unit counts as another one: a unit that nothing has shown to
// be wrong is kept; that of a new map was a first estimate.
constexpr double kSigmasOfOneMap = 2.5, kSigmasOfANewMap = 1;

}  // namespace

DoubtEvaluation evaluate_doubt(const Pinhole& pinhole, const std::optional<SureView>& before,
                               const SureView& now, const std::function<double(int)>& scale_of) {
  const bool is_new_map = before && before->segment != now.segment;
  DoubtEvaluation found;
  DoubtEnded& ended = found.ended;
  // There is nothing before the first map; and a view that is still in use is one of this map.
  ended.is_evaluated = !before || is_new_map || before->reference == now.reference;
  if (!before || before->reference == now.reference) return found;
  if (!is_new_map) ended.last_sure_keyframe = before->reference->keyframe_id;
  UnitComparison& unit = found.unit.emplace();
  const auto link = link_views(pinhole, before->reference->cloud, now.reference->cloud);
  if (!link) return found;
  ended.is_evaluated = true;
  unit = {link->scale * scale_of(before->segment) / scale_of(now.segment), link->sigma};
  const double sigmas = is_new_map ? kSigmasOfANewMap : kSigmasOfOneMap;
  if (std::abs(std::log(unit.ratio)) > sigmas * unit.sigma) ended.length_ratio = unit.ratio;
  return found;
}

std::string in_words(const UnitComparison& unit) {
  if (!unit.is_linked()) return "nothing links the map to that before the doubt";
  return "lengths before over after the doubt: " + fixed(unit.ratio, 3) + " +- " +
         fixed(100 * unit.sigma, 1) + " %";
}

}  // namespace edgevo
