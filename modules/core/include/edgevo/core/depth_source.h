// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What gave the depth of a line.
#include <cstdint>

namespace edgevo {

/// Where the depth of a line is from.
enum class DepthSource : uint8_t {
  /// The views that show it.
  kViews,
  /// A plane of its host's view, which it lies on (edge_map/README.md).
  kPlane
};
/// Name of `source` in files.
inline const char* to_string(DepthSource source) { return source == DepthSource::kPlane ? "plane" : "views"; }

}  // namespace edgevo
