// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A keyframe of the map file as two strings of bytes: its place (pose and points), which is written anew at
// the end of a run, and its view, which is not.
#include <optional>
#include <string>
#include <string_view>

#include "edgevo/places/place_store.h"

namespace edgevo {

/// What a map knows of the place of a keyframe.
struct KeyframePlace {
  /// Id of the keyframe, and number of its epoch in the run.
  int id = 0, epoch = 0;
  /// Frame, time, segment, pose and points.
  KeyframeRecord record;
};

/// The bytes of a place. Points at infinity or behind the camera, lines and gray levels on the sides of lines
/// are not kept.
std::string bytes_of(const KeyframePlace& place);
/// The place back: pixels to 1/32, normals to 0.7 degrees, inverse depths to 0.02 %, their standard
/// deviations to 2 %, observations up to 255. Nothing if the bytes are damaged.
std::optional<KeyframePlace> read_place(std::string_view bytes);

/// The bytes of a view.
std::string bytes_of(const RememberedView& view);
/// The view back: corners to 1/32 pixel, all else as it was. Nothing if the bytes are damaged.
std::optional<RememberedView> read_view(std::string_view bytes);

}  // namespace edgevo
