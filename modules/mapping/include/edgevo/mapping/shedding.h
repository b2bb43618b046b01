// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is skipped where the machine is too slow for its camera, in this order; each step includes those
// before it.

namespace edgevo {

/// How much work is shed.
enum class Shedding {
  /// None.
  kNothing,
  /// New lines of edges.
  kLines,
  /// Depths from frames between keyframes.
  kDepths,
  /// Half of the points of the window and of the new ones.
  kPoints,
};

}  // namespace edgevo
