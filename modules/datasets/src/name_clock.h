// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Clocks in the names of images, with and without a date:
//
//   frame_00_01_27.000               hours, minutes and seconds
//   235957_100                       the same without separators, with milliseconds
//   2026-05-17T23:59:57.100Z         a date and a clock, ISO 8601, also 20260517_235957_100,
//                                    20260517235957100 and 2026-05-17_23-59-57.1
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Clocks of the images of a folder.
struct NameClocks {
  /// Since 1970 with a date (as if in UTC), else since midnight.
  std::vector<Timestamp> times;
  /// Whether there is a date.
  bool dated = false;
};

/// The clocks in the names without suffix, in the order of the names; nullopt unless all names have one of
/// the same form, and no two are equal.
std::optional<NameClocks> clocks_of_names(const std::vector<std::string>& stems);

}  // namespace edgevo
