// SPDX-License-Identifier: BSD-3-Clause
#include "lasting_edges.h"

#include <opencv2/imgproc.hpp>

#include "edgevo/run_loop/run_odometry.h"
#include "edgevo/simulation/relit_source.h"
#include "edgevo/simulation/rendered_source.h"

namespace edgevo::training {
namespace {

// The camera is known, and each keyframe keeps all of its own lines, however far: whether an edge lasts does
// not depend on the accuracy of its depth.
OdometryParams params_of_labels() {
  OdometryParams params;
  params.camera.refine = "none";
  params.edge_map.mode = "keyframes";
  params.edge_map.step_px = 2, params.edge_map.min_vertices = 4;
  params.edge_map.max_relative_sigma = 1;
  return params;
}

cv::Point pixel_of(const EdgeVertex& vertex) {
  return {int(std::lround(vertex.px.x())), int(std::lround(vertex.px.y()))};
}

cv::Mat label_of(const KeyframeRecord& keyframe, cv::Size size) {
  cv::Mat label = cv::Mat::zeros(size, CV_8U);
  for (const EdgeLine& line : keyframe.lines)
    for (size_t i = 1; i < line.vertices.size(); ++i)
      cv::line(label, pixel_of(line.vertices[i - 1]), pixel_of(line.vertices[i]), 255);
  return label;
}

}  // namespace

std::vector<LabelledFrame> lasting_edges(const Scene& scene, uint64_t seed) {
  const auto renderer = std::make_shared<const SceneRenderer>(scene);
  RelitSource source(std::make_unique<RenderedSource>(renderer), Relight("mixed", seed));
  RunLoopOptions options;
  options.odometry.seed = seed;
  const RunResult driven =
      run_odometry(source, params_of_labels(), options, [](const ProcessedFrame&) { return true; });
  const Pinhole image = scene.camera.pinhole();
  std::vector<LabelledFrame> all;
  for (const KeyframeRecord& k : driven.run.keyframes)
    all.push_back({k.frame_index, label_of(k, {image.width, image.height})});
  return all;
}

}  // namespace edgevo::training
