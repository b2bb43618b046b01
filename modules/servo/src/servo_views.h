// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Three views of a servo run with the points of the feed: true (crosses) and desired positions (circles).
#include <cstdint>
#include <string>
#include <vector>

#include "edgevo/servo/loop_result.h"

namespace edgevo {

/// A view as a picture.
struct ServoView {
  /// "start", "taught" or "final".
  std::string name;
  /// Bytes of the PNG file.
  std::vector<uint8_t> png;
};

/// The views that the run reached.
std::vector<ServoView> views_of(const ServoResult& r);

}  // namespace edgevo
