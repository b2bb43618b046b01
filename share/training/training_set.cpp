// SPDX-License-Identifier: BSD-3-Clause
#include "training_set.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/random.h"
#include "edgevo/core/run_parallel.h"
#include "edgevo/simulation/relight.h"
#include "edgevo/simulation/true_edge_labels.h"
#include "lasting_edges.h"

namespace edgevo::training {
namespace {

cv::Mat as_mat(const GrayImage& image) {
  return cv::Mat(image.height, image.width, CV_8U, const_cast<uint8_t*>(image.pixels.data())).clone();
}

GrayImage as_image(const cv::Mat& mat) {
  return {mat.cols, mat.rows, std::vector<uint8_t>(mat.data, mat.data + mat.total())};
}

// A pinhole camera, so that labels and image coincide; noise is added later.
Scene clean_scene(const World& world) {
  Scene scene = load_scene(world.scene, world.seed);
  scene.camera.set_distortion({});
  scene.noise_sigma = 0;
  return scene;
}

// Largest slope of the 3x3 pixels around, gray levels per pixel.
cv::Mat steepness(const cv::Mat& gray) {
  cv::Mat dx, dy, magnitude;
  cv::Sobel(gray, dx, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(gray, dy, CV_32F, 0, 1, 3, 0.125);
  cv::magnitude(dx, dy, magnitude);
  cv::dilate(magnitude, magnitude, cv::Mat::ones(3, 3, CV_8U));
  return magnitude;
}

// Smallest slope in the clean image, gray levels per pixel: above the noise of `relight` (standard deviation
// 8). A step between two equal grays cannot be learned, and the grain of asphalt disappears with the next
// change of light.
constexpr float kLearnedSlope = 8;

cv::Mat visible_edges(const cv::Mat& labels, const cv::Mat& clean) {
  cv::Mat visible = labels.clone();
  visible.setTo(0, steepness(clean) < kLearnedSlope);
  return visible;
}

// ---- labels ----

// Index of the i-th of `wanted` items at equal steps among `size`.
int at_equal_steps(int i, int wanted, size_t size) { return int((i + 0.5) * double(size) / wanted); }

std::vector<LabelledFrame> with_true_edges(const SceneRenderer& renderer, int frames) {
  std::vector<LabelledFrame> labelled(static_cast<size_t>(frames));
  run_parallel(0, frames, 2, [&](int i) {
    const int index = at_equal_steps(i, frames, size_t(renderer.size()));
    const cv::Mat clean = as_mat(renderer.render_image(index));
    labelled[size_t(i)] = {index, visible_edges(as_mat(true_edge_labels(renderer, index)), clean)};
  });
  return labelled;
}

std::vector<LabelledFrame> with_lasting_edges(const Scene& scene, int frames, uint64_t seed) {
  const std::vector<LabelledFrame> keyframes = lasting_edges(scene, seed);
  if (keyframes.empty())
    throw InputError("scene " + scene.name, "its run made no keyframe, so it has no lasting edges",
                     "use another seed of the world");
  std::vector<LabelledFrame> chosen;
  for (int i = 0; i < frames; ++i)
    chosen.push_back(keyframes[size_t(at_equal_steps(i, frames, keyframes.size()))]);
  return chosen;
}

std::vector<LabelledFrame> labelled_frames(const SceneRenderer& renderer, const Plan& plan) {
  return plan.label == Label::kTrue ? with_true_edges(renderer, plan.frames)
                                    : with_lasting_edges(renderer.scene(), plan.frames, plan.seed);
}

// ---- light and camera ----

bool happens(Random& random, double share) { return random.uniform() < share; }

cv::Mat in_other_light(const cv::Mat& clean, const std::string& kind, int index, Random& random) {
  const Relight light(kind, random.next());
  return as_mat(light.apply(as_image(clean), index, random.uniform(0, 60)));
}

cv::Mat with_noise(const cv::Mat& gray, double sigma, Random& random) {
  cv::Mat noisy = gray.clone();
  for (int v = 0; v < gray.rows; ++v)
    for (int u = 0; u < gray.cols; ++u)
      noisy.at<uint8_t>(v, u) =
          cv::saturate_cast<uint8_t>(double(gray.at<uint8_t>(v, u)) + sigma * random.normal());
  return noisy;
}

cv::Mat as_jpeg(const cv::Mat& gray, int quality) {
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", gray, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
}

// Effects of lens, sensor and file, each on some images only, so that clean ones are among them.
cv::Mat through_camera(cv::Mat gray, Random& random) {
  if (happens(random, 0.3)) cv::GaussianBlur(gray, gray, {}, random.uniform(0.4, 1.4));
  if (happens(random, 0.6)) gray = with_noise(gray, random.uniform(0.5, 4), random);
  if (happens(random, 0.4)) gray = as_jpeg(gray, 30 + random.below(66));
  return gray;
}

// In random light, with the effects of a camera.
cv::Mat as_taken(const cv::Mat& clean, int index, Random& random) {
  const auto& kinds = relight_kinds();
  const int kind = random.below(int(kinds.size()) + 1);  // one more for unchanged light
  const cv::Mat lit =
      kind == int(kinds.size()) ? clean.clone() : in_other_light(clean, kinds[size_t(kind)], index, random);
  return through_camera(lit, random);
}

cv::Rect any_piece(const Plan& plan, cv::Size image, Random& random) {
  const int width = std::min(plan.width, image.width), height = std::min(plan.height, image.height);
  const int v = random.below(image.height - height + 1), u = random.below(image.width - width + 1);
  return {u, v, width, height};
}

std::vector<Sample> samples_of_frame(const SceneRenderer& renderer, const LabelledFrame& labelled,
                                     const Plan& plan, Random random) {
  const auto& [index, label] = labelled;
  const cv::Mat clean = as_mat(renderer.render_image(index));
  std::vector<Sample> samples;
  for (const std::string& light : plan.lights) {
    const cv::Rect piece = any_piece(plan, clean.size(), random);
    const cv::Mat gray = light == "none" ? clean : in_other_light(clean, light, index, random);
    samples.push_back({gray(piece).clone(), label(piece).clone()});
  }
  for (int i = 0; plan.lights.empty() && i < plan.pieces; ++i) {
    const cv::Mat gray = as_taken(clean, index, random);
    const cv::Rect piece = any_piece(plan, clean.size(), random);
    samples.push_back({gray(piece).clone(), label(piece).clone()});
  }
  return samples;
}

Plan training_plan() {
  Plan plan;
  plan.worlds = {{"street", 11},    {"desk", 11},      {"lakeshore", 11}, {"street", 12},
                 {"desk", 12},      {"lakeshore", 12}, {"street", 13},    {"desk", 13},
                 {"lakeshore", 13}, {"street", 14},    {"rotation", 11}};
  return plan;
}

Plan lasting_plan() {
  Plan plan = training_plan();
  plan.label = Label::kLasting;
  return plan;
}

Plan test_plan() {
  Plan plan;
  plan.worlds = {{"corridor", 91}, {"street", 91}, {"desk", 91}, {"lakeshore", 91}};
  plan.frames = 4;
  plan.seed = 2;
  plan.lights = relight_kinds();
  plan.lights.insert(plan.lights.begin(), "none");
  return plan;
}

}  // namespace

Plan plan_named(const std::string& name) {
  if (name == "train") return training_plan();
  if (name == "lasting") return lasting_plan();
  if (name == "test") return test_plan();
  throw InputError("training set", "there is none named `" + name + "`", "use train, lasting or test");
}

std::vector<Sample> make_samples(const Plan& plan) {
  std::vector<Sample> all;
  for (size_t w = 0; w < plan.worlds.size(); ++w) {
    const SceneRenderer renderer(clean_scene(plan.worlds[w]));
    const std::vector<LabelledFrame> frames = labelled_frames(renderer, plan);
    std::vector<std::vector<Sample>> by_frame(size_t(plan.frames));
    run_parallel(0, plan.frames, 2, [&](int i) {
      by_frame[size_t(i)] = samples_of_frame(renderer, frames[size_t(i)], plan,
                                             Random::derive(plan.seed, w * 1000 + uint64_t(i)));
    });
    for (auto& samples : by_frame) all.insert(all.end(), samples.begin(), samples.end());
  }
  return all;
}

void write_samples(const std::string& path, const std::vector<Sample>& samples) {
  std::string bytes = "edgevo training set 1\n" + std::to_string(samples.size()) + " " +
                      std::to_string(samples.front().gray.cols) + " " +
                      std::to_string(samples.front().gray.rows) + "\n";
  for (const Sample& s : samples)
    for (const cv::Mat& m : {s.gray, s.label}) bytes.append(reinterpret_cast<const char*>(m.data), m.total());
  write_file(path, bytes);
}

}  // namespace edgevo::training
