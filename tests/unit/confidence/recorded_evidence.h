// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The evidence on each frame of a run as the trust takes it, and what the trust made of it: a table that is
// written, read and replayed. A row a frame; an empty field is unknown; a row "-" is a frame without a pose.
// Numbers have few digits, and what came out is that of the rounded evidence: a file is right by itself.
#include <string>
#include <vector>

#include "edgevo/confidence/frame_status.h"
#include "edgevo/confidence/motion_confidence.h"

namespace edgevo::test {

/// What a frame brings to the trust.
struct RecordedFrame {
  /// Whether it has a pose; if not, all else is unused.
  bool has_pose = false;
  /// Segment of the map.
  int segment = 0;
  /// Tangent of T_before_cam, the motion since the frame before.
  Vector6d motion = Vector6d::Zero();
  /// The evidence; all of pose_sigmas are the largest one.
  FrameEvidence evidence;
};

/// What trust and status make of it.
struct Outcome {
  Inconsistencies doubts{};
  double p_right = 0;
  TrackingState state = TrackingState::kLost;
};

/// A frame and what came out; nothing without a pose.
struct EvidenceRow {
  RecordedFrame frame;
  std::optional<Outcome> outcome;
};

/// Passes frames through MotionConfidence and frame_status(), in time order.
class EvidenceReplay {
 public:
  std::optional<Outcome> add(const RecordedFrame& frame);

 private:
  MotionHistory history_;
  MotionConfidence trust_;
  SE3 T_map_cam_;
  int segment_ = -1;
};

/// The frame as it is read again after it was written.
RecordedFrame rounded(const RecordedFrame& frame);
/// The table; the outcomes are written as they are.
std::string to_text(const std::vector<EvidenceRow>& rows);
/// Throws InputError for a file that is missing, or whose columns are others.
std::vector<EvidenceRow> read_evidence(const std::string& path);

/// Whether a value is the recorded one in all digits that the table gives it.
bool is_same_p(double value, double recorded);
bool is_same_doubt(double value, double recorded);

/// Name of a doubt in the table.
const char* name_of_doubt(size_t doubt);

}  // namespace edgevo::test
