// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The topics of run.mcap, and the names of its frames.
#include <string>

#include "mcap_file.h"

namespace edgevo {

/// Names of the frames (REP-105), and of the camera's with z forward (REP-103).
inline constexpr const char *kMapFrame = "map", *kOdomFrame = "odom", *kBaseFrame = "base_link",
                            *kCameraFrame = "camera_optical_frame";

/// The topics, in the order of the table in topics.cpp.
enum class Topic : uint16_t {
  kTf,
  kTfStatic,
  kOdometry,
  kPose,
  kPoseWithCovariance,
  kPath,
  kPoints,
  kEdges,
  kEdgePoints,
  kGrid,
  kCameraInfo,
  kImage,
  kLog,
  kIsMetric,
  kMapChanges,
};

/// The file with its topics.
class TopicFile {
 public:
  /// Begins the file.
  TopicFile(const std::string& path, const std::string& library);
  /// Appends a message; `time`: when it was known.
  void write(Topic topic, Timestamp time, const std::string& message) {
    file_.add_message(uint16_t(topic), time, message);
  }
  /// McapFile::end_chunk()
  void end_chunk() { file_.end_chunk(); }
  /// Writes the rest and closes.
  void finish(const McapPairs& metadata) { file_.finish("edgevo", metadata); }

 private:
  McapFile file_;
};

}  // namespace edgevo
