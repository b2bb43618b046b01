// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/reason.h"

#include <array>

namespace edgevo {
namespace {

// In the order of the enum; part of the format of frames.csv.
constexpr std::array<std::string_view, 8> kNames{"",          "parallax",   "rotation", "view leaves",
                                                 "fast turn", "long since", "return",   "bootstrap"};

}  // namespace

std::string_view to_string(KeyframeReason reason) { return kNames[size_t(reason)]; }

std::optional<KeyframeReason> parse_keyframe_reason(std::string_view name) {
  for (size_t i = 0; i < kNames.size(); ++i)
    if (kNames[i] == name) return KeyframeReason(i);
  return std::nullopt;
}

}  // namespace edgevo
