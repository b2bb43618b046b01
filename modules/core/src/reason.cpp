// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/reason.h"

#include <algorithm>
#include <cstdio>

namespace edgevo {
namespace {

std::string scale_in_words(double ratio, double frames) {
  char text[80];
  if (ratio < 1)
    std::snprintf(text, sizeof text, "scale fell by %.2f within %.0f frames", 1 - ratio, frames);
  else
    std::snprintf(text, sizeof text, "scale grew by a factor of %.2f within %.0f frames", ratio, frames);
  return text;
}

// For printf: the first number is `value`, the second `other`.
const char* pattern_of(ReasonKind kind) {
  switch (kind) {
    case ReasonKind::kSkipped:
    case ReasonKind::kScaleByCorners:
      return "";
    case ReasonKind::kFirstView:
      return "first view taken";
    case ReasonKind::kNewFirstView:
      return "new first view";
    case ReasonKind::kFewCorners:
      return "only %.0f corners in the image, %.0f needed";
    case ReasonKind::kCornersLost:
      return "only %.0f corners could be followed, %.0f needed";
    case ReasonKind::kLittleMotion:
      return "median motion %.1f px, %.1f px needed: move the camera sideways or on, or take away what "
             "stands still in its view";
    case ReasonKind::kTooLong:
      return "too little motion for too long";
    case ReasonKind::kNoMotionFits:
      return "no essential matrix fits the corners";
    case ReasonKind::kFewAgree:
      return "only %.0f %% of the corners agree on one motion, %.0f %% needed: much moves by itself, or "
             "images are blurred or blended";
    case ReasonKind::kTwoMotionsFit:
      return "two different motions fit the %.0f corners equally well: more parallax needed, or larger "
             "images";
    case ReasonKind::kFewInFront:
      return "only %.0f corners lie in front of both views, %.0f needed";
    case ReasonKind::kLittleParallax:
      return "median parallax %.2f deg, %.2f deg needed: the motion is mostly rotation, or the scene far "
             "away";
    case ReasonKind::kFewPointsMatched:
      return "only %.0f edge points matched in the first views";
    case ReasonKind::kSearchBehind:
      return "followed only: the bootstrap is behind";
    case ReasonKind::kMapBegun:
      return "two views found: a map is being made";
    case ReasonKind::kMapInMaking:
      return "a map is being made";
    case ReasonKind::kMayBeLocated:
      return "looked for in the kept map first";
    case ReasonKind::kMayBeEgoPart:
      return "what moves may not be the scene, the camera seems to stand, or a part is fixed to it: "
             "the map waits (--mask names what is fixed)";
    case ReasonKind::kStands:
      return "the camera seems to stand: move it, or mask what is fixed to it (--mask)";
    case ReasonKind::kDiverged:
      return "alignment diverged";
    case ReasonKind::kFewPointsInView:
      return "only %.0f map points in view, %.0f are needed";
    case ReasonKind::kInlierShare:
      return "inlier share %.2f is below %.2f";
    case ReasonKind::kStep:
      return "a step of %.0f times the usual one";
    case ReasonKind::kRotationByCorners:
      return "rotation over 10 frames differs from the corners' by %.1f degrees";
    case ReasonKind::kTranslationByCorners:
      return "translation over 10 frames differs from the corners' by %.0f %% of its length";
    case ReasonKind::kFocalLength:
      return "a turn with a focal length that the corners put %.0f %% off";
    case ReasonKind::kTurn:
      return "a translation that the turn hides";
    case ReasonKind::kSteps:
      return "steps unlike those before";
    case ReasonKind::kResidual:
      return "edges are %.1f px off where the map puts them";
    case ReasonKind::kLittleInformation:
      return "edges hardly determine the motion (%.1f %% of the depth, or of a radian)";
    case ReasonKind::kMapMoved:
      return "the map moved under the camera within 10 frames (by %.1f %% of the depth)";
    case ReasonKind::kZoom:
      return "the images zoom by %.1f %% within 10 frames";
    case ReasonKind::kUnitCarried:
      return "a turn with hardly a translation, in which a unit of length is carried on to %.0f %% only";
  }
  return "";
}

bool is_share(ReasonKind kind) {
  return kind == ReasonKind::kFewAgree || kind == ReasonKind::kTranslationByCorners ||
         kind == ReasonKind::kFocalLength || kind == ReasonKind::kLittleInformation ||
         kind == ReasonKind::kMapMoved || kind == ReasonKind::kUnitCarried || kind == ReasonKind::kZoom;
}

}  // namespace

std::string to_string(const Reason& reason) {
  constexpr double kMaxShown = 9999;  // of a step after a standstill of no step at all
  if (reason.kind == ReasonKind::kScaleByCorners) return scale_in_words(reason.value, reason.other);
  const double unit = is_share(reason.kind) ? 100 : 1;
  const double value = reason.kind == ReasonKind::kStep ? std::min(reason.value, kMaxShown) : reason.value;
  char text[160];
  std::snprintf(text, sizeof text, pattern_of(reason.kind), unit * value, unit * reason.other);
  return text;
}

std::string to_string(const Reasons& reasons) {
  std::string text;
  for (const Reason& r : reasons) text += (text.empty() ? "" : "; ") + to_string(r);
  return text;
}

Reasons joined(Reasons first, const Reasons& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

bool are_alike(const Reasons& a, const Reasons& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Reason& x, const Reason& y) { return x.kind == y.kind; });
}

}  // namespace edgevo
