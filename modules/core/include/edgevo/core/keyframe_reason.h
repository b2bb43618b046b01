#pragma once
// Why a frame called for a keyframe.
#include <optional>
#include <string_view>

namespace edgevo {

/// The criterion that called for a keyframe (odometry/src/keyframe_policy.cpp), or how else the frame became
/// one.
enum class KeyframeReason {
  /// Nothing called for a keyframe.
  kNone,
  /// Translation has moved the image.
  kParallax,
  /// A rotation, even without translation, has turned the map out of view.
  kRotation,
  /// The next frame would see too little of the map.
  kViewLeaves,
  /// Each frame loses much of the view.
  kFastTurn,
  /// Many frames have passed.
  kLongSince,
  /// The camera is back at an older keyframe, which becomes the reference; none is made.
  kReturn,
  /// The frame is a view of the bootstrap.
  kBootstrap,
};

/// As in frames.csv: "parallax", "view leaves", ...; empty for kNone.
std::string_view to_string(KeyframeReason reason);
/// The reason of such a name; nothing for a name that is not known.
std::optional<KeyframeReason> parse_keyframe_reason(std::string_view name);

}  // namespace edgevo
