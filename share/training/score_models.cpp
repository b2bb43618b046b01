// SPDX-License-Identifier: BSD-3-Clause
// edgevo_score_models NETWORK.onnx FOREST.yml.gz [FRAMES]: tabulates, by light, the scores of the detectors
// in worlds on which no model was trained.
//
// F: harmonic mean of precision and recall over all pixels of a light, at the number of edges
// (edges.canny_percentile) that maximises it over the whole set. Recall and precision: at the default number,
// which is that of Canny for all detectors. Detected and true pixels match within 1.5 pixels.
#include <algorithm>
#include <cstdio>
#include <map>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/error.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/edges/edge_probability.h"
#include "edgevo/edges/image_edges.h"
#include "training_set.h"

namespace edgevo::training {
namespace {

constexpr double kTolerance = 1.5;  // pixels

// Detector with its model, and its masks of one image for any number of edges.
class Contestant {
 public:
  Contestant(const std::string& detector, const std::string& model) : name(detector) {
    params_.detector = detector;
    params_.model = model;
    probability_ = make_edge_probability(params_, all_edge_detectors());
  }
  void look_at(const cv::Mat& gray) {
    gray_ = {gray.data, gray.cols, gray.rows, gray.cols};
    gradient_ = compute_gradient(gray_);
    if (probability_) found_ = probability_->estimate(gray_, "");
  }
  cv::Mat mask(double percentile) {
    params_.canny_percentile = percentile;
    const Plane<uint8_t> mask =
        make_edge_detector(params_, all_edge_detectors())->detect({gray_, gradient_, found_.view()});
    return cv::Mat(gray_.height, gray_.width, CV_8U, const_cast<uint8_t*>(mask.row(0))).clone();
  }
  std::string name;

 private:
  EdgeParams params_;
  std::unique_ptr<EdgeProbability> probability_;
  ImageView<uint8_t> gray_;
  Gradient gradient_;
  Plane<uint8_t> found_;
};

// ---- counting ----

struct Count {
  double right = 0, found = 0, met = 0, truth = 0;
  void add(const Count& c) { right += c.right, found += c.found, met += c.met, truth += c.truth; }
  double precision() const { return found > 0 ? right / found : 0; }
  double recall() const { return truth > 0 ? met / truth : 0; }
  double f() const {
    return precision() + recall() > 0 ? 2 * precision() * recall() / (precision() + recall()) : 0;
  }
};

double share_near(const cv::Mat& of, const cv::Mat& to) {
  cv::Mat distance;
  cv::distanceTransform(to == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return cv::countNonZero(of & (distance <= kTolerance));
}

// The border that no detector uses does not count.
Count compare(const cv::Mat& mask, const cv::Mat& label) {
  const cv::Rect inside(kEdgelessBorder, kEdgelessBorder, mask.cols - 2 * kEdgelessBorder,
                        mask.rows - 2 * kEdgelessBorder);
  const cv::Mat found = mask(inside) > 0, truth = label(inside) > 0;
  return {share_near(found, truth), double(cv::countNonZero(found)), share_near(truth, found),
          double(cv::countNonZero(truth))};
}

struct Figures {
  std::map<double, Count> by_percentile;
  Count by_default;
  double best_f() const {
    double best = 0;
    for (const auto& [percentile, count] : by_percentile) best = std::max(best, count.f());
    return best;
  }
};

void score_image(Contestant& contestant, const Sample& s, Figures* figures) {
  contestant.look_at(s.gray);
  for (const double percentile : {0.7, 0.75, 0.8, 0.85, 0.9, 0.94})
    figures->by_percentile[percentile].add(compare(contestant.mask(percentile), s.label));
  figures->by_default.add(compare(contestant.mask(EdgeParams().canny_percentile), s.label));
}

void print_row(const std::string& worlds, const std::string& light, const std::vector<Figures>& all) {
  std::printf("| %s | %s |", worlds.c_str(), light.c_str());
  for (const Figures& f : all)
    std::printf(" %.3f; %.3f / %.3f |", f.best_f(), f.by_default.recall(), f.by_default.precision());
  std::printf("\n");
  std::fflush(stdout);
}

std::vector<Contestant> contestants(const std::string& network, const std::string& forest) {
  std::vector<Contestant> all;
  all.emplace_back("canny", "");
  all.emplace_back("structured", forest);
  all.emplace_back("combined:structured", forest);
  all.emplace_back("network", network);
  all.emplace_back("combined:network", network);
  return all;
}

void evaluate(const std::string& network, const std::string& forest, int frames) {
  Plan plan = plan_named("test");
  if (frames > 0) plan.frames = frames;
  std::vector<Contestant> all = contestants(network, forest);
  const std::vector<Sample> samples = make_samples(plan);
  std::printf("| worlds | light |");
  for (const Contestant& c : all) std::printf(" %s |", c.name.c_str());
  std::printf("\n|---|---|---|---|---|---|---|\n");
  const size_t lights = plan.lights.size(),
               of_kept_kind = size_t(plan.frames) * lights;  // the first world: a kind not trained on
  for (const bool is_kept_kind : {true, false})
    for (size_t light = 0; light < lights; ++light) {
      std::vector<Figures> figures(all.size());
      const size_t end = is_kept_kind ? of_kept_kind : samples.size();
      for (size_t i = light + (is_kept_kind ? 0 : of_kept_kind); i < end; i += lights)
        for (size_t c = 0; c < all.size(); ++c) score_image(all[c], samples[i], &figures[c]);
      print_row(is_kept_kind ? "corridor" : "other seeds", plan.lights[light], figures);
    }
}

}  // namespace
}  // namespace edgevo::training

int main(int argc, char** argv) try {
  if (argc < 3)
    throw edgevo::InputError("edgevo_score_models", "a network and a forest are required",
                             "write edgevo_score_models NETWORK.onnx FOREST.yml.gz [FRAMES]");
  cv::setNumThreads(1);
  edgevo::training::evaluate(argv[1], argv[2], argc > 3 ? std::atoi(argv[3]) : 0);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "edgevo_score_models: %s\n", e.what());
  return 2;
}
