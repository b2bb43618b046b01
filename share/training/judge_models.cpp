// edgevo_judge_models NETWORK.onnx FOREST.yml.gz [FRAMES]: what the models find in worlds they were not
// trained on, by light, as a table.
//
// F: harmonic mean of precision and recall over all pixels of a light, at the threshold that is best for it
// over the whole set (one threshold for all images, ODS; for Canny one percentile). Recall at Canny's count:
// each image's most probable pixels, as many as Canny (default parameters) finds in it. A found pixel is
// right, a true one found, within 1.5 pixels. Probabilities are thinned along the image's own gradient.
#include <algorithm>
#include <cstdio>
#include <map>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/structured_edge_detection.hpp>

#include "edgevo/core/error.h"
#include "edgevo/edges/edge_detector.h"
#include "edgevo/edges/edge_map.h"
#include "edgevo/simulation/true_edge_labels.h"
#include "training_set.h"

namespace edgevo::training {
namespace {

constexpr double kTolerance = 1.5;  // pixels

// ---- detectors: CV_32F, larger is likelier ----

ImageView<uint8_t> view(const cv::Mat& gray) { return {gray.data, gray.cols, gray.rows, gray.cols}; }

cv::Mat network_probability(cv::dnn::Net& net, const cv::Mat& gray) {
  cv::Mat scaled;
  gray.convertTo(scaled, CV_32F, 4.0 / 255.0, -2.0);  // edge_network.yaml: (gray / 255 - 0.5) / 0.25
  const int shape[] = {1, 1, gray.rows, gray.cols};
  net.setInput(cv::Mat(4, shape, CV_32F, scaled.data), "gray");
  const cv::Mat out = net.forward("edges");
  return cv::Mat(gray.rows, gray.cols, CV_32F, const_cast<float*>(out.ptr<float>())).clone();
}

cv::Mat forest_probability(cv::ximgproc::StructuredEdgeDetection& forest, const cv::Mat& gray) {
  cv::Mat colour, found;
  cv::cvtColor(gray, colour, cv::COLOR_GRAY2RGB);
  colour.convertTo(colour, CV_32F, 1.0 / 255.0);
  forest.detectEdges(colour, found);
  return found;
}

cv::Mat canny_mask(const cv::Mat& gray, double percentile) {
  EdgeParams params;
  params.canny_percentile = percentile;
  const Plane<uint8_t> mask = make_edge_detector(params)->detect(view(gray), compute_gradient(view(gray)));
  return cv::Mat(gray.rows, gray.cols, CV_8U, const_cast<uint8_t*>(mask.row(0))).clone();
}

// Zero where a neighbour along the image's gradient is likelier.
cv::Mat thinned(const cv::Mat& probability, const cv::Mat& gray) {
  const Gradient g = compute_gradient(view(gray));
  cv::Mat thin = cv::Mat::zeros(probability.size(), CV_32F);
  for (int v = kEdgelessBorder; v < gray.rows - kEdgelessBorder; ++v)
    for (int u = kEdgelessBorder; u < gray.cols - kEdgelessBorder; ++u) {
      const float dx = g.dx.at(u, v), dy = g.dy.at(u, v), length = std::hypot(dx, dy);
      if (length == 0) continue;
      const int du = int(std::lround(dx / length)), dv = int(std::lround(dy / length));
      const float p = probability.at<float>(v, u);
      if (p > probability.at<float>(v - dv, u - du) && p >= probability.at<float>(v + dv, u + du))
        thin.at<float>(v, u) = p;
    }
  return thin;
}

cv::Mat most_probable(const cv::Mat& thin, int count) {
  std::vector<float> values(thin.begin<float>(), thin.end<float>());
  count = std::clamp(count, 1, int(values.size()));
  std::nth_element(values.begin(), values.begin() + count - 1, values.end(), std::greater<float>());
  return thin >= std::max(values[size_t(count - 1)], 1e-9f);
}

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

// The border that no detector looks at does not count.
Count compare(const cv::Mat& mask, const cv::Mat& label) {
  const cv::Rect inside(kEdgelessBorder, kEdgelessBorder, mask.cols - 2 * kEdgelessBorder,
                        mask.rows - 2 * kEdgelessBorder);
  const cv::Mat found = mask(inside) > 0, truth = label(inside) > 0;
  return {share_near(found, truth), double(cv::countNonZero(found)), share_near(truth, found),
          double(cv::countNonZero(truth))};
}

struct Figures {
  std::map<int, Count> by_threshold;  // ODS
  Count at_canny;
  double best_f() const {
    double best = 0;
    for (const auto& [threshold, count] : by_threshold) best = std::max(best, count.f());
    return best;
  }
};

void judge_probability(const cv::Mat& probability, const Sample& s, int canny_count, Figures* figures) {
  const cv::Mat thin = thinned(probability, s.gray);
  for (int t = 1; t < 20; ++t) figures->by_threshold[t].add(compare(thin >= float(t) / 20, s.label));
  figures->at_canny.add(compare(most_probable(thin, canny_count), s.label));
}

void judge_canny(const Sample& s, const cv::Mat& by_default, Figures* figures) {
  for (const int percent : {70, 75, 80, 85, 90, 93, 96})
    figures->by_threshold[percent].add(compare(canny_mask(s.gray, percent / 100.0), s.label));
  figures->at_canny.add(compare(by_default, s.label));
}

void print(const std::string& light, const std::string& part,
           const std::vector<std::pair<const char*, Figures>>& all) {
  std::printf("| %s | %s |", part.c_str(), light.c_str());
  for (const auto& [name, f] : all)
    std::printf(" %.3f | %.3f / %.3f |", f.best_f(), f.at_canny.recall(), f.at_canny.precision());
  std::printf("\n");
  std::fflush(stdout);
}

void judge(const std::string& network, const std::string& forest_file, int frames) {
  Plan plan = test_plan();
  if (frames > 0) plan.frames = frames;
  cv::dnn::Net net = cv::dnn::readNetFromONNX(network);
  net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
  const auto forest = cv::ximgproc::createStructuredEdgeDetection(forest_file);
  const std::vector<Sample> samples = make_samples(plan);
  std::printf(
      "| worlds | light | Canny F | recall / precision | structured F | at Canny's count | network F | at "
      "Canny's count |\n|---|---|---|---|---|---|---|---|\n");
  const size_t lights = plan.lights.size(),
               kept_kind =
                   size_t(plan.frames) * lights;  // the first world is of a kind that was not trained on
  for (const bool is_kept_kind : {true, false})
    for (size_t light = 0; light < lights; ++light) {
      std::vector<std::pair<const char*, Figures>> all{{"canny", {}}, {"structured", {}}, {"network", {}}};
      for (size_t i = is_kept_kind ? light : kept_kind + light;
           i < (is_kept_kind ? kept_kind : samples.size()); i += lights) {
        const cv::Mat canny = canny_mask(samples[i].gray, EdgeParams().canny_percentile);
        const int count = cv::countNonZero(canny);
        judge_canny(samples[i], canny, &all[0].second);
        judge_probability(forest_probability(*forest, samples[i].gray), samples[i], count, &all[1].second);
        judge_probability(network_probability(net, samples[i].gray), samples[i], count, &all[2].second);
      }
      print(plan.lights[light], is_kept_kind ? "corridor" : "street, desk, lakeshore, other seeds", all);
    }
}

}  // namespace
}  // namespace edgevo::training

int main(int argc, char** argv) try {
  if (argc < 3)
    throw edgevo::InputError("edgevo_judge_models", "needs a network and a forest",
                             "write edgevo_judge_models NETWORK.onnx FOREST.yml.gz [FRAMES]");
  cv::setNumThreads(1);
  edgevo::training::judge(argv[1], argv[2], argc > 3 ? std::atoi(argv[3]) : 0);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "edgevo_judge_models: %s\n", e.what());
  return 2;
}
