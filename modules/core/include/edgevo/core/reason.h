// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Why a frame has no pose, or one that is not to be trusted: a kind, to count and compare by, and the numbers
// that were measured; sentences are made of them at the end. And why a frame becomes a keyframe.
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace edgevo {

/// Kinds of reasons; behind each, what Reason::value and Reason::other are.
enum class ReasonKind : uint8_t {
  /// The frame was skipped; the record's note has the words.
  kSkipped,

  // ---- there is no map yet ----
  /// The first view of a map was taken.
  kFirstView,
  /// The first view is given up, and the newest is the first one.
  kNewFirstView,
  /// Corners in the image; needed.
  kFewCorners,
  /// Corners that could be followed; needed.
  kCornersLost,
  /// Median motion of the corners, pixels; needed.
  kLittleMotion,
  /// The motion stayed too little for too long.
  kTooLong,
  /// No essential matrix fits.
  kNoMotionFits,
  /// Share of the corners that agree on one motion; needed.
  kFewAgree,
  /// Two motions fit equally well.
  kTwoMotionsFit,
  /// Corners in front of both views; needed.
  kFewInFront,
  /// Median parallax, degrees; needed.
  kLittleParallax,
  /// Edge points that were matched in the first views.
  kFewPointsMatched,
  /// The search for two views is behind: corners are followed only.
  kSearchBehind,
  /// Two views were found, a map is being made of them.
  kMapBegun,
  /// A map is being made.
  kMapInMaking,
  /// The camera may be located in a map that was kept: the run's own waits for it.
  kMayBeLocated,
  /// Part of the view may be fixed to the camera: the map waits.
  kMayBeEgoPart,
  /// The camera seems to stand.
  kStands,

  // ---- the image does not support the pose ----
  /// The pose is not finite.
  kDiverged,
  /// Map points in view; needed.
  kFewPointsInView,
  /// Inlier share; that below which it counts.
  kInlierShare,
  /// Length of the step over the usual one.
  kStep,

  // ---- the motion is doubted (confidence/motion_confidence.h) ----
  /// Length ratio over so many frames, by the corners; the frames.
  kScaleByCorners,
  /// Difference of the rotation over ten frames to that of the corners, degrees.
  kRotationByCorners,
  /// Difference of the translation over ten frames to that of the corners, as a share of its length.
  kTranslationByCorners,
  /// Error of the focal length by the corners, as a share.
  kFocalLength,
  /// A turn that hides the translation.
  kTurn,
  /// Steps unlike those before.
  kSteps,
  /// Distance of edges to where the map puts them, pixels.
  kResidual,
  /// Largest standard deviation of the pose, as a share of the depth or in radians.
  kLittleInformation,
  /// Length by which adjustments have moved the camera within ten frames, as a share of the depth.
  kMapMoved,
  /// Standard deviation of the unit of length that the map has carried over the last fifty frames, as a
  /// share.
  kUnitCarried,
  /// Change of the size of the images over ten frames that no pose explains, as a share.
  kZoom,
};
/// The last kind.
inline constexpr ReasonKind kLastReasonKind = ReasonKind::kZoom;

/// A reason; a number that its kind does not have is NaN.
struct Reason {
  /// What it is.
  ReasonKind kind = ReasonKind::kSkipped;
  /// Its numbers, see ReasonKind.
  double value = std::numeric_limits<double>::quiet_NaN(), other = std::numeric_limits<double>::quiet_NaN();
};
/// Reasons, that of the image before that of the motion; empty: nothing speaks against the frame.
using Reasons = std::vector<Reason>;

/// "inlier share 0.12 is below 0.15"; empty for kSkipped.
std::string to_string(const Reason& reason);
/// All of them, separated by "; ".
std::string to_string(const Reasons& reasons);
/// `first`, then `second`.
Reasons joined(Reasons first, const Reasons& second);
/// Whether two lists have the same kinds in the same order, whatever their numbers are.
bool are_alike(const Reasons& a, const Reasons& b);

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
