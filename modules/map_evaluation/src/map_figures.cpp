// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map_evaluation/map_figures.h"

#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "compared_frame.h"
#include "edgevo/core/depth_source.h"
#include "edgevo/core/error.h"
#include "missing_causes.h"

namespace edgevo {
namespace {

constexpr double kBands[] = {2, 5, 10, 20, 40, 100};  // metres: hands to roads
// Kinds are of the nearest band with this share of all edges: a robot meets those.
constexpr double kNearShare = 0.25;

// A pixel of a piece of a line in one frame.
struct Sample {
  size_t piece;
  float depth;
  EdgePlace place;
  bool is_hidden, is_right;
};

// All samples on a map.
class Samples {
 public:
  explicit Samples(size_t pieces)
      : nearest_(pieces, std::numeric_limits<float>::infinity()), is_right_there_(pieces, false) {}

  void add(const ComparedFrame& c) {
    for (size_t d = 0; d < c.drawn.size(); ++d) {
      const Sample v{c.drawn[d].piece, float(c.drawn[d].depth), c.place[d], c.is_hidden[d], c.is_right[d]};
      all_.push_back(v);
      if (v.is_hidden) continue;
      if (v.depth < nearest_[v.piece]) nearest_[v.piece] = v.depth, is_right_there_[v.piece] = v.is_right;
    }
  }
  // Calls `f` with the sample, and whether it is right. What a frame sees from too far to resolve is right if
  // the nearest one finds the edge; what is hidden counts only if it always is.
  template <class F>
  void each(const F& f) const {
    for (const Sample& v : all_)
      if (!v.is_hidden || !std::isfinite(nearest_[v.piece]))
        f(v, !v.is_hidden && (v.is_right || is_right_there_[v.piece]));
  }

 private:
  std::vector<Sample> all_;
  std::vector<float> nearest_;        // by piece: the least depth at which it is seen
  std::vector<bool> is_right_there_;  // whether it lies at an edge there
};

struct Bands {
  Bands() {
    for (const double limit : kBands) limits.push_back(limit);
    limits.push_back(std::numeric_limits<double>::infinity());
    figures.resize(limits.size());
    for (size_t i = 0; i < limits.size(); ++i)
      figures[i].name = i + 1 < limits.size() ? "within " + std::to_string(int(limits[i])) + " m" : "all";
  }
  template <class F>
  void at(double depth, const F& f) {
    for (size_t i = 0; i < limits.size(); ++i)
      if (depth <= limits[i]) f(&figures[i]);
  }
  std::vector<double> limits;
  std::vector<MapFigure> figures;
};

struct KindCount {
  double depth;
  TrueEdge kind;
  EdgePlace place;
  Thing thing;
  bool is_along, is_found;
};

std::vector<MapFigure> count_kinds(const std::vector<KindCount>& edges, double near_m) {
  std::vector<MapFigure> kinds(6);
  const char* names[] = {"outlines", "creases",          "texture",
                         "no label", "along the motion", "across the motion"};
  for (size_t i = 0; i < kinds.size(); ++i) kinds[i].name = names[i];
  for (const KindCount& e : edges) {
    if (e.depth > near_m) continue;
    const size_t kind = e.kind == TrueEdge::depth_step ? 0
                        : e.kind == TrueEdge::crease   ? 1
                        : e.kind == TrueEdge::texture  ? 2
                                                       : 3;
    for (MapFigure* m : {&kinds[kind], &kinds[e.is_along ? 4 : 5]}) ++m->edges, m->found += e.is_found;
  }
  return kinds;
}

std::vector<MapFigure> count_places(const std::vector<KindCount>& edges, const Samples& samples,
                                    double near_m) {
  std::vector<MapFigure> places(3);
  const char* names[] = {"on the ground", "upright", "others above"};
  for (size_t i = 0; i < places.size(); ++i) places[i].name = names[i];
  for (const KindCount& e : edges)
    if (e.depth <= near_m) ++places[size_t(e.place)].edges, places[size_t(e.place)].found += e.is_found;
  samples.each([&](const Sample& v, bool is_right) {
    if (double(v.depth) <= near_m) ++places[size_t(v.place)].drawn, places[size_t(v.place)].right += is_right;
  });
  return places;
}

std::vector<MapFigure> count_classes(const std::vector<KindCount>& edges, double near_m) {
  std::vector<MapFigure> classes(kThings);
  for (size_t i = 0; i < classes.size(); ++i) classes[i].name = to_string(Thing(i));
  for (const KindCount& e : edges)
    if (e.depth <= near_m) ++classes[size_t(e.thing)].edges, classes[size_t(e.thing)].found += e.is_found;
  return classes;
}

std::vector<MissingFigure> count_causes(const std::vector<MissingEdge>& edges, double near_m) {
  std::vector<MissingFigure> causes;
  for (int i = 0; i < kMissingCauses; ++i) causes.push_back({MissingCause(i), {}});
  for (const MissingEdge& e : edges)
    if (e.depth <= near_m) ++causes[size_t(cause_of(e))].edges[size_t(e.thing)];
  return causes;
}

double near_limit(const Bands& bands) {
  const double all = double(bands.figures.back().edges);
  for (size_t i = 0; i + 1 < bands.limits.size(); ++i)
    if (double(bands.figures[i].edges) >= kNearShare * all) return bands.limits[i];
  return bands.limits.back();
}

}  // namespace

double MapFigure::f() const {
  const double sum = completeness() + rightness();
  return sum > 0 ? 2 * completeness() * rightness() / sum : 0;
}

int64_t MissingFigure::all() const { return std::accumulate(edges.begin(), edges.end(), int64_t(0)); }

bool MapFigures::is_of_another_scene() const {
  constexpr double kOwnScene = 0.5;  // share of the lines
  return bands.back().drawn > 0 && bands.back().rightness() < kOwnScene;
}

MapFigures evaluate_map(const Run& map, const SceneRenderer& scene, const MapEvaluationOptions& options) {
  const PlacedLines lines = place_lines(map, scene.scene());
  PyramidBuilder builder(scene.camera(), EdgeParams());
  const int end = options.end < 0 ? lines.last_frame + 1 : std::min(options.end, scene.size());
  MapFigures result;
  result.metres_per_unit = lines.metres_per_unit;
  Bands bands;
  std::vector<KindCount> kinds;
  std::vector<MissingEdge> missing;
  Samples samples(lines.pieces.size());
  for (int i = options.begin; i < end; i += options.every) {
    const ComparedFrame c(scene, &builder, lines, i, options);
    ++result.frames;
    for (size_t e = 0; e < c.is_found.size(); ++e) {
      const TrueEdgePixel& t = c.view.edges()[e];
      bands.at(t.depth, [&](MapFigure* m) { ++m->edges, m->found += c.is_found[e]; });
      kinds.push_back({t.depth, t.kind, c.view.place_of(t.px, t.normal, t.depth), t.thing, t.is_along_motion,
                       c.is_found[e]});
      if (!options.why || c.is_found[e]) continue;
      missing.emplace_back(t, c.view.T_scene_cam(), c.view.pinhole(), options.depth_share);
      missing.back().is_misplaced = c.is_misplaced[e];
    }
    samples.add(c);
  }
  result.sources.resize(2);
  for (const DepthSource s : {DepthSource::kViews, DepthSource::kPlane})
    result.sources[size_t(s)].name = to_string(s);
  samples.each([&](const Sample& v, bool is_right) {
    const auto add = [&](MapFigure* m) { ++m->drawn, m->right += is_right; };
    bands.at(double(v.depth), add);
    add(&result.sources[size_t(lines.pieces[v.piece].source)]);
  });
  result.bands = bands.figures;
  result.near_m = near_limit(bands);
  result.kinds = count_kinds(kinds, result.near_m);
  result.places = count_places(kinds, samples, result.near_m);
  result.classes = count_classes(kinds, result.near_m);
  if (options.why) {
    look_from_all_frames(scene, options.begin, end, options.depth_share, &missing);
    result.causes = count_causes(missing, result.near_m);
  }
  return result;
}

std::string map_picture_png(const Run& map, const SceneRenderer& scene, int index,
                            const MapEvaluationOptions& options) {
  if (index < 0 || index >= scene.size())
    throw InputError("the picture", "there is no frame " + std::to_string(index), "give a smaller number");
  constexpr int kTimes = 2;  // larger
  PyramidBuilder builder(scene.camera(), EdgeParams());
  const ComparedFrame c(scene, &builder, place_lines(map, scene.scene()), index, options);
  cv::Mat picture(c.view.pinhole().height, c.view.pinhole().width, CV_8UC3);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      picture.at<cv::Vec3b>(y, x) =
          cv::Vec3b::all(uint8_t(c.view.image().pixels[size_t(y * picture.cols + x)] / 3));
  cv::resize(picture, picture, {}, kTimes, kTimes, cv::INTER_NEAREST);
  const auto dot = [&](const Eigen::Vector2d& px, const cv::Vec3b& colour) {
    const cv::Point at(int(kTimes * (px.x() + 0.5)), int(kTimes * (px.y() + 0.5)));
    if (at.inside({0, 0, picture.cols, picture.rows})) picture.at<cv::Vec3b>(at) = colour;
  };
  for (size_t e = 0; e < c.is_found.size(); ++e)
    dot(c.view.edges()[e].px, c.is_found[e] ? cv::Vec3b{60, 220, 60} : cv::Vec3b{60, 60, 255});
  for (size_t d = 0; d < c.drawn.size(); ++d)
    if (!c.is_hidden[d] && !c.is_right[d]) dot(c.drawn[d].px, {255, 140, 40});
  std::vector<uchar> png;
  cv::imencode(".png", picture, png);
  return {png.begin(), png.end()};
}

}  // namespace edgevo
