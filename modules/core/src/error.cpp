// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/error.h"

#include <algorithm>

#include "edgevo/core/suggestion.h"

namespace edgevo {

std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
  const auto best = std::min_element(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  return best == candidates.end() ? std::string() : *best;
}

}  // namespace edgevo
