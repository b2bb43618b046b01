// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Why a frame requested a keyframe.
#include <optional>
#include <string_view>

namespace edgevo {

/// Criterion that requested a keyframe (tracking/keyframe_policy.h), or another way in which the frame
/// became one.
enum class KeyframeReason {
  /// No keyframe was requested.
  kNone,
  /// Translation has caused enough parallax.
  kParallax,
  /// Rotation, possibly without translation, has turned the map out of view.
  kRotation,
  /// The next frame would see too little of the map.
  kViewLeaves,
  /// The view changes quickly from frame to frame.
  kFastTurn,
  /// The maximum interval between keyframes has passed.
  kLongSince,
  /// The camera has returned to an older keyframe, which becomes the reference; no keyframe is made.
  kReturn,
  /// The frame is a view of the bootstrap.
  kBootstrap,
};

/// Name in frames.csv: "parallax", "view leaves", ...; empty for kNone.
std::string_view to_string(KeyframeReason reason);
/// Inverse of to_string(); nullopt for an unknown name.
std::optional<KeyframeReason> parse_keyframe_reason(std::string_view name);

}  // namespace edgevo
