// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The time stamps that a video's container holds for its frames. OpenCV gives that of a packet instead of a
// frame, and none for the last frames.
#include <string>
#include <vector>

namespace edgevo {

struct VideoStamps {
  /// Seconds since the first frame, in the order in which the frames are shown; empty if the container holds
  /// none that increase.
  std::vector<double> seconds;
  /// Numbers, from 0, of frames that the file's index lists but whose data is not where it says, although
  /// that of a later one is: the file is damaged amid. Increasing. AVI loses such frames without a gap in
  /// `seconds`.
  std::vector<int> missing;
  /// Whether the index lists every frame: `seconds` and `missing` together are all of them.
  bool is_complete = false;
  /// True if the pixels have more than 8 bits of gray, of which OpenCV gives the upper ones.
  bool is_16_bit_gray = false;
};

/// Reads the stamps of the first video stream. Decodes nothing: the cost is that of reading the file. Empty
/// for a file that does not open.
VideoStamps read_video_stamps(const std::string& path);

/// Whether FFmpeg would draw the file's letters as pictures: it takes a long text for a video.
bool is_drawn_text(const std::string& path);

/// Whether the frames are the same time apart, within the resolution of a container (a millisecond) or a
/// hundredth of a frame.
bool have_rate(const std::vector<double>& seconds, double fps);

}  // namespace edgevo
