// SPDX-License-Identifier: BSD-3-Clause
#include "missing_edges.h"

#include <algorithm>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/error.h"

namespace edgevo::test {
namespace {

constexpr float kNearPx = 2;         // from a true edge to the pixel that shows it
constexpr float kMinCosine = 0.75f;  // between their normals

// By the cell of a true edge.
using Losses = std::map<TrueEdges::Cell, EdgeLoss>;

// The edge pixel of the run that shows a true one; -1: none does.
int shown_by(const TruePixel& t, const PyramidLevel& level) {
  const int j = level.field.nearest(t.px.x(), t.px.y());
  if (j < 0) return -1;
  const EdgePixel& e = level.edges.pixels[size_t(j)];
  const bool is_near = (e.position() - t.px).norm() <= kNearPx;
  return is_near && std::abs(e.normal().dot(t.normal)) >= kMinCosine ? j : -1;
}

// Vertices are placed every step_px: the trace of the nearest one along the chain.
TracedPixel trace_near(int j, const ImageEdges& edges, const std::vector<TracedPixel>& trace) {
  constexpr int kReach = 5;
  TracedPixel best = trace[size_t(j)];
  for (int step = -1; step <= 1; step += 2)
    for (int i = edges.neighbour(j, step), n = 1; i >= 0 && n <= kReach; i = edges.neighbour(i, step), ++n)
      if (trace[size_t(i)].stage > best.stage) best = trace[size_t(i)];
  return best;
}

EdgeLoss loss_of(const TrueEdges& truth, const EdgeReplay& replay, size_t k, const TruePixel& t) {
  const PyramidLevel& level = replay.pyramids[k]->finest();
  const int j = shown_by(t, level);
  const auto trace = replay.trace.find(int(k));
  if (j < 0 || trace == replay.trace.end()) return {};
  const TracedPixel traced = trace_near(j, level.edges, trace->second);
  const bool is_found = traced.stage >= EdgeStage::kFound;
  if (!(traced.idepth > 0)) return {Loss::kGate, traced.stage};
  const double z = truth.scale() / traced.idepth;
  const Eigen::Vector3d p = z * replay.run.pinhole.ray(t.px.cast<double>());
  if ((p - t.p_cam).norm() > truth.tolerance()) return {is_found ? Loss::kOff : Loss::kGate, traced.stage};
  if (!is_found) return {Loss::kDoubted, traced.stage};
  return {traced.stage == EdgeStage::kKept ? Loss::kPose : Loss::kFusion, traced.stage};
}

Losses losses_of(const TrueEdges& truth, const EdgeReplay& replay) {
  Losses losses;
  const auto lines = truth.cells_of_lines(replay.run);
  for (size_t k = 0; k < replay.pyramids.size(); ++k)
    for (const TruePixel& t : truth.pixels()[k]) {
      if (!truth.is_counted(t.cell)) continue;
      EdgeLoss& loss = losses[t.cell];
      if (loss.loss == Loss::kThere) continue;
      if (truth.is_reconstructed(t.cell, lines))
        loss = {Loss::kThere, EdgeStage::kKept};
      else
        loss = std::max(loss, loss_of(truth, replay, k, t));
    }
  return losses;
}

cv::Vec3b colour_of(const EdgeLoss& l) {  // blue, green, red
  switch (l.loss) {
    case Loss::kThere:
      return {60, 160, 60};
    case Loss::kDetector:
      return {255, 255, 255};
    case Loss::kOff:
      return {60, 60, 255};
    case Loss::kFusion:
      return {0, 255, 255};
    case Loss::kPose:
      return {160, 160, 160};
    default:
      break;
  }
  if (l.stage == EdgeStage::kAlongMotion || l.stage == EdgeStage::kNoMotion) return {255, 120, 40};
  if (l.stage == EdgeStage::kUncertain) return {255, 255, 0};
  if (l.stage == EdgeStage::kFewViews || l.stage == EdgeStage::kNoSupport) return {255, 0, 255};
  return {0, 140, 255};
}

}  // namespace

std::string to_string(const EdgeLoss& l) {
  static const std::vector<std::string> words{"no edge pixel", "no depth: ",       "right, but doubted: ",
                                              "wrong depth, ", "lost in fusion: ", "pose, ",
                                              "there"};
  const bool has_stage = l.loss != Loss::kDetector && l.loss != Loss::kThere;
  return words[size_t(l.loss)] + (has_stage ? to_string(l.stage) : "");
}

std::vector<std::pair<EdgeLoss, double>> missing_edges(const TrueEdges& truth, const EdgeReplay& replay) {
  std::map<EdgeLoss, int> counts;
  const Losses losses = losses_of(truth, replay);
  for (const auto& [cell, loss] : losses) ++counts[loss];
  std::vector<std::pair<EdgeLoss, double>> shares;
  for (const auto& [loss, n] : counts) shares.emplace_back(loss, double(n) / double(losses.size()));
  return shares;
}

void draw_missing_edges(const TrueEdges& truth, const EdgeReplay& replay, int k, const std::string& path) {
  if (k < 0 || k >= int(replay.pyramids.size()))
    throw InputError("picture", "there is no keyframe " + std::to_string(k), "give a smaller number");
  constexpr int kTimes = 2;  // larger
  const Plane<uint8_t>& gray = replay.pyramids[size_t(k)]->finest().gray;
  cv::Mat picture(gray.height(), gray.width(), CV_8UC3);
  for (int y = 0; y < gray.height(); ++y)
    for (int x = 0; x < gray.width(); ++x) {
      const uint8_t g = uint8_t(gray.at(x, y) / 4);
      picture.at<cv::Vec3b>(y, x) = {g, g, g};
    }
  cv::resize(picture, picture, {}, kTimes, kTimes, cv::INTER_NEAREST);
  const Losses losses = losses_of(truth, replay);
  for (const TruePixel& t : truth.pixels()[size_t(k)]) {
    const auto loss = losses.find(t.cell);
    if (loss == losses.end()) continue;
    const cv::Point at(int(kTimes * (t.px.x() + 0.5f)), int(kTimes * (t.px.y() + 0.5f)));
    if (at.inside({0, 0, picture.cols, picture.rows})) picture.at<cv::Vec3b>(at) = colour_of(loss->second);
  }
  if (!cv::imwrite(path, picture)) throw InputError(path, "cannot be written", "name another file");
}

}  // namespace edgevo::test
