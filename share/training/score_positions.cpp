// SPDX-License-Identifier: BSD-3-Clause
// edgevo_score_positions [FRAMES] [SEED] [NETWORK.onnx FOREST.yml.gz]: tabulates, by light, the localisation
// and the repeatability of the edges of detectors on rendered frames. It uses street and desk of a seed on
// which no model was trained, and the models of edgevo by default.
//
// Offset: from a detected edge pixel, along its normal (dark to bright), to the true line of a depth step or
// crease within 1.5 px; the line is known to an eighth of a pixel from labels of four times the resolution.
// Bias is the mean, sigma the standard deviation. Repeated: of the edge pixels whose point
// is visible in the next frame, the share that has an edge pixel within 1.5 px there; carried over by exact
// depth and pose.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/error.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/simulation/correspondence.h"
#include "edgevo/simulation/relight.h"
#include "edgevo/simulation/true_edge_labels.h"

namespace edgevo::training {
namespace {

constexpr double kReach = 1.5;  // pixels
constexpr int kFiner = 4;       // resolution of labels over that of the image

// Pixel (u, v) of the coarse image is the centre of kFiner x kFiner fine ones.
double to_fine(double coarse) { return kFiner * coarse + 0.5 * (kFiner - 1); }

Scene finer(Scene scene) {
  const Pinhole p = scene.camera.pinhole();
  scene.camera.set_pinhole(
      {p.fx * kFiner, p.fy * kFiner, to_fine(p.cx), to_fine(p.cy), p.width * kFiner, p.height * kFiner});
  return scene;
}

Scene plain_scene(const char* name, uint64_t seed) {
  Scene scene = load_scene(name, seed);
  scene.camera.set_distortion({});
  return scene;
}

bool is_geometry(const GrayImage& labels, int u, int v) {
  if (u < 0 || v < 0 || u >= labels.width || v >= labels.height) return false;
  return labels.pixels[size_t(v) * size_t(labels.width) + size_t(u)] > uint8_t(TrueEdge::texture);
}

// Offset along the normal from the edge to the centre of the nearest true line, pixels; nullopt if none is
// within reach.
std::optional<double> offset_to_truth(const EdgePixel& edge, const GrayImage& fine) {
  const int steps = int(kReach * kFiner);
  const auto hit = [&](int step) {
    const double t = double(step) / kFiner;
    return is_geometry(fine, int(std::lround(to_fine(double(edge.x) + t * double(edge.nx)))),
                       int(std::lround(to_fine(double(edge.y) + t * double(edge.ny)))));
  };
  for (int step = 0; step <= steps; ++step)
    for (const int sign : {1, -1}) {
      if (!hit(sign * step)) continue;
      int low = sign * step, high = low;
      while (high < steps && hit(high + 1)) ++high;
      while (low > -steps && hit(low - 1)) --low;
      return 0.5 * (low + high) / kFiner;
    }
  return std::nullopt;
}

// Mask that is nonzero within reach of an edge pixel.
cv::Mat near_to(const ImageEdges& edges) {
  cv::Mat free(edges.height, edges.width, CV_8U, cv::Scalar(1)), distance;
  for (const EdgePixel& e : edges.pixels) free.at<uint8_t>(int(std::lround(e.y)), int(std::lround(e.x))) = 0;
  cv::distanceTransform(free, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance <= kReach;
}

bool is_marked(const cv::Mat& mask, const Eigen::Vector2d& px) {
  const int u = int(std::lround(px.x())), v = int(std::lround(px.y()));
  return u >= 0 && v >= 0 && u < mask.cols && v < mask.rows && mask.at<uint8_t>(v, u) != 0;
}

// Sums of localisation and repeatability.
struct Localisation {
  std::vector<double> offsets;
  double edges = 0, visible = 0, repeated = 0;

  void add_offsets(const ImageEdges& found, const GrayImage& fine) {
    edges += double(found.pixels.size());
    for (const EdgePixel& edge : found.pixels)
      if (const auto offset = offset_to_truth(edge, fine)) offsets.push_back(*offset);
  }
  void add_repeats(const ImageEdges& found, const PyramidLevel& next, const ViewPair& views) {
    const cv::Mat near = near_to(next.edges);
    for (const EdgePixel& edge : found.pixels) {
      const Correspondence c = find_correspondence(views, edge.position().cast<double>());
      if (!c.visible) continue;
      ++visible;
      repeated += is_marked(near, c.px);
    }
  }
};

struct Figures {
  double bias, sigma, repeated;
};

Figures figures_of(const Localisation& places) {
  const double count = std::max<double>(1, double(places.offsets.size()));
  double sum = 0, squares = 0;
  for (const double o : places.offsets) sum += o, squares += o * o;
  const double bias = sum / count;
  return {bias, std::sqrt(std::max(0.0, squares / count - bias * bias)),
          places.repeated / std::max(1.0, places.visible)};
}

GrayImage in_light(const GrayImage& image, const std::string& light, int index, double seconds) {
  return light == "none" ? image : Relight(light, 7).apply(image, index, seconds);
}

// Pair of consecutive frames, rendered once, in the light of their time.
struct Pair {
  int index;
  double seconds, seconds_next;
  GrayImage image, next, fine_labels;
  std::vector<float> depth, depth_next;
  SE3 T_next_cam;
};

std::vector<Pair> make_pairs(const Scene& scene, int count) {
  const SceneRenderer renderer(scene), fine(finer(scene));
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    const int index = int((i + 0.5) * (renderer.size() - 1) / count);
    pairs.push_back({index, scene.times[size_t(index)].seconds(), scene.times[size_t(index) + 1].seconds(),
                     renderer.render_image(index), renderer.render_image(index + 1),
                     true_edge_labels(fine, index), renderer.render_depth(index),
                     renderer.render_depth(index + 1),
                     renderer.T_world_cam(index + 1).inverse() * renderer.T_world_cam(index)});
  }
  return pairs;
}

void score_pair(const Pair& pair, const Camera& camera, const std::string& light, const EdgeParams& params,
                Localisation* places) {
  PyramidBuilder builder(camera, params, all_edge_detectors());
  const auto from = builder.build(in_light(pair.image, light, pair.index, pair.seconds));
  const auto to = builder.build(in_light(pair.next, light, pair.index + 1, pair.seconds_next));
  const int width = camera.pinhole().width, height = camera.pinhole().height;
  const ViewPair views{builder.pinhole(),
                       {pair.depth.data(), width, height, width},
                       {pair.depth_next.data(), width, height, width},
                       pair.T_next_cam};
  places->add_offsets(from->finest().edges, pair.fine_labels);
  places->add_repeats(from->finest().edges, to->finest(), views);
}

struct Contestant {
  std::string detector, model;  // model: a file; empty: that of edgevo, or none
};

void evaluate(const char* name, int frames, uint64_t seed, const std::vector<Contestant>& contestants) {
  const Scene scene = plain_scene(name, seed);
  const std::vector<Pair> pairs = make_pairs(scene, frames);
  for (const char* light : {"none", "blur", "noise", "shadows", "glare", "mixed"}) {
    std::printf("| %s | %s |", name, light);
    for (const Contestant& c : contestants) {
      EdgeParams params;
      params.detector = c.detector;
      params.model = c.model;
      Localisation places;
      for (const Pair& pair : pairs) score_pair(pair, scene.camera, light, params, &places);
      const Figures f = figures_of(places);
      std::printf(" %+.2f, %.2f; %.1f; %.0f |", f.bias, f.sigma, 100 * f.repeated, places.edges / frames);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

void score_all(int frames, uint64_t seed, const std::string& network, const std::string& forest) {
  const std::vector<Contestant> contestants{{"canny", ""},
                                            {"edge_drawing", ""},
                                            {"structured", forest},
                                            {"network", network},
                                            {"combined:network", network}};
  std::printf("Bias and sigma, px; repeated, %%; edge pixels per frame.\n\n| scene | light |");
  for (const Contestant& c : contestants) std::printf(" %s |", c.detector.c_str());
  std::printf("\n|---|---|---|---|---|---|---|\n");
  for (const char* name : {"street", "desk"}) evaluate(name, frames, seed, contestants);
}

}  // namespace
}  // namespace edgevo::training

int main(int argc, char** argv) try {
  edgevo::training::score_all(argc > 1 ? std::max(1, std::atoi(argv[1])) : 2,
                              argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 91, argc > 4 ? argv[3] : "",
                              argc > 4 ? argv[4] : "");
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "edgevo_score_positions: %s\n", e.what());
  return 2;
}
