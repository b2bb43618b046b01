// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace edgevo {

/// The cells of a grid, by row, for which `is_member(number)` is true, in groups of cells that lie within
/// `reach` cells of each other, 1: eight neighbours.
template <class IsMember>
std::vector<std::vector<int>> cell_groups(int columns, int rows, int reach, const IsMember& is_member) {
  std::vector<uint8_t> waits(size_t(columns) * size_t(rows));
  for (size_t i = 0; i < waits.size(); ++i) waits[i] = is_member(i);
  std::vector<std::vector<int>> groups;
  for (size_t first = 0; first < waits.size(); ++first) {
    if (!waits[first]) continue;
    waits[first] = 0;
    std::vector<int> group = {int(first)};
    for (size_t next = 0; next < group.size(); ++next) {
      const int x = group[next] % columns, y = group[next] / columns;
      for (int v = std::max(0, y - reach); v <= std::min(rows - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(columns - 1, x + reach); ++u) {
          uint8_t& other = waits[size_t(v * columns + u)];
          if (!other) continue;
          other = 0;
          group.push_back(v * columns + u);
        }
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace edgevo
