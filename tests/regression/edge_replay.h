// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The edge map of a run, rebuilt from its final poses keyframe by keyframe, with a trace of each edge pixel:
// at which stage it was rejected.
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "edgevo/core/image_source.h"
#include "edgevo/core/records.h"
#include "edgevo/edge_map/edge_trace.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/odometry/odometry_params.h"

namespace edgevo::test {

/// Wraps a source and keeps its images.
class KeepingSource : public ImageSource {
 public:
  explicit KeepingSource(std::unique_ptr<ImageSource> source) : source_(std::move(source)) {}
  const Camera& camera() const override { return source_->camera(); }
  std::optional<int> size() const override { return source_->size(); }
  std::string kind() const override { return source_->kind(); }
  std::optional<Frame> next() override;

  const GrayImage& image(int frame_index) const { return images_.at(frame_index); }

 private:
  std::unique_ptr<ImageSource> source_;
  std::map<int, GrayImage> images_;
};

struct EdgeReplay {
  /// The run with the rebuilt lines.
  Run run;
  /// Traces of the edge pixels by index into Run::keyframes.
  EdgeTrace trace;
  /// Image pyramid of each keyframe.
  std::vector<std::shared_ptr<const FramePyramid>> pyramids;
  /// CPU time of the whole edge map, milliseconds.
  double cpu_ms = 0;
};

/// Rebuilds the edge map of `run`. Poses and points differ slightly from those at the time when a keyframe
/// was marginalised.
/// `between` passes the frames after a keyframe, with their motion from it.
using BetweenFrames = std::function<void(
    int keyframe,
    const std::function<void(const SE3& T_view_keyframe, std::shared_ptr<const FramePyramid>)>& add)>;
EdgeReplay replay_edges(const KeepingSource& source, const Run& run, const OdometryParams& params,
                        const BetweenFrames& between = {});

}  // namespace edgevo::test
