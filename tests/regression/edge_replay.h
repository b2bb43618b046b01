#pragma once
// The edge map of a run made again from its final poses, keyframe by keyframe, with the trace of every edge
// pixel: which gate it did not pass.
#include <map>
#include <memory>
#include <vector>

#include "edgevo/core/image_source.h"
#include "edgevo/core/records.h"
#include "edgevo/edge_map/edge_trace.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/odometry/odometry_params.h"

namespace edgevo::test {

/// Plays a source and keeps its images.
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
  Run run;                                                    ///< with the lines of the replay
  EdgeTrace trace;                                            ///< by index into Run::keyframes
  std::vector<std::shared_ptr<const FramePyramid>> pyramids;  ///< of each keyframe
  double cpu_ms = 0;                                          ///< of the edge map, all of it
};

/// Poses and points differ a little from those that the run had when a keyframe left the window.
EdgeReplay replay_edges(const KeepingSource& source, const Run& run, const OdometryParams& params);

}  // namespace edgevo::test
