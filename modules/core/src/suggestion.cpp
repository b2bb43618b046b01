// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/suggestion.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "edgevo/core/error.h"

namespace edgevo {

size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);  // one row of the table at a time
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i);
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substitute = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
    }
  }
  return row.back();
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr size_t kLongest = 64;  // no key is longer, and the cost grows with the length
  if (word.size() > kLongest) return {};
  const std::string nearest = nearest_name(word, candidates);
  const size_t letters = std::max(word.size(), nearest.size());
  if (nearest.empty() || 3 * edit_distance(word, nearest) > letters) return {};
  return "did you mean '" + nearest + "'?";
}

}  // namespace edgevo
