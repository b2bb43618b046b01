// SPDX-License-Identifier: BSD-3-Clause
// OpenCV evaluates the forest exactly as the trainer does: features, walks and predictions are identical, and
// the same seed gives the same file.
#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/structured_edge_detection.hpp>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "forest_file.h"
#include "support/temp_folder.h"
#include "training_set.h"

namespace edgevo::training {
namespace {

// Bright discs on noise, with their outlines.
Sample discs(uint64_t seed) {
  Random random(seed);
  Sample s{cv::Mat(96, 128, CV_8U), cv::Mat::zeros(96, 128, CV_8U)};
  for (int i = 0; i < 5; ++i) {
    const cv::Point centre(random.below(128), random.below(96));
    const int radius = 8 + random.below(16);
    cv::circle(s.label, centre, radius, 255, 1);
  }
  cv::floodFill(s.label, cv::Point(64, 48), 128);
  cv::Mat(s.label == 128).convertTo(s.gray, CV_8U, 0.4, 60);
  s.label = s.label == 255;
  for (int v = 0; v < 96; ++v)
    for (int u = 0; u < 128; ++u)
      s.gray.at<uint8_t>(v, u) = cv::saturate_cast<uint8_t>(s.gray.at<uint8_t>(v, u) + 6 * random.normal());
  return s;
}

ForestShape small_shape() {
  ForestShape shape;
  shape.trees = 3, shape.trees_evaluated = 2;
  return shape;
}

std::vector<Example> examples_of(const Sample& sample, const FeatureMaps& maps) {
  std::vector<Example> examples;
  for (int row = 0; row < maps.rows() - 8; row += 2)
    for (int col = 0; col < maps.cols() - 8; col += 2) {
      examples.push_back({&maps, row, col, {}});
      for (int i = 0; i < kInner * kInner; ++i)
        examples.back().edges[size_t(i)] =
            sample.label.at<uint8_t>(2 * row + i / kInner, 2 * col + i % kInner) != 0;
    }
  return examples;
}

std::vector<Tree> small_forest(uint64_t seed) {
  const ForestShape shape = small_shape();
  const Sample sample = discs(5);
  const FeatureMaps maps(sample.gray, shape);
  const std::vector<Example> examples = examples_of(sample, maps);
  std::vector<const Example*> all;
  for (const Example& e : examples) all.push_back(&e);
  std::vector<Tree> trees;
  for (int t = 0; t < shape.trees; ++t)
    trees.push_back(grow_tree(all, shape, {6, 8, 20}, Random::derive(seed, uint64_t(t))));
  return trees;
}

// Prediction by the trainer's own walk: a patch every two pixels, two of three trees evaluated in turn, the
// predictions added up and smoothed like in OpenCV.
cv::Mat answered(const std::vector<Tree>& trees, const ForestShape& s, const cv::Mat& gray) {
  const FeatureMaps maps(gray, s);
  const float step = 2.0f * float(s.stride * s.stride) / float(s.inner * s.inner) / float(s.trees_evaluated);
  cv::Mat sum = cv::Mat::zeros(gray.size(), CV_32F), smooth;
  for (int row = 0; row < maps.rows(); ++row)
    for (int col = 0; col < maps.cols(); ++col)
      for (int k = 0; k < s.trees_evaluated; ++k) {
        const Tree& tree = trees[size_t(((row + col) % (2 * s.trees_evaluated) + k) % s.trees)];
        const EdgePatch& edges = tree.answers[size_t(walk(tree, maps, row, col))];
        for (int i = 0; i < kInner * kInner; ++i)
          if (edges[size_t(i)])
            sum.at<float>(row * s.stride + i / kInner, col * s.stride + i % kInner) += step;
      }
  const std::vector<float> weights{0.25f, 0.5f, 0.25f};
  cv::sepFilter2D(sum, smooth, -1, weights, weights);
  return smooth;
}

cv::Mat detected(const std::string& path, const cv::Mat& gray) {
  cv::Mat colour, found;
  cv::cvtColor(gray, colour, cv::COLOR_GRAY2RGB);
  colour.convertTo(colour, CV_32F, 1.0 / 255.0);
  cv::ximgproc::createStructuredEdgeDetection(path)->detectEdges(colour, found);
  return found;
}

TEST(Forest, OpenCvPredictsExactlyWhatTheTrainerDoes) {
  const test::TempFolder temp;
  const std::vector<Tree> trees = small_forest(1);
  ASSERT_GT(trees[0].childs.size(), 5u);
  write_forest(temp / "forest.yml.gz", trees, small_shape());
  const cv::Mat gray = discs(9).gray;  // another image than that of the training
  const cv::Mat expected = answered(trees, small_shape(), gray),
                found = detected(temp / "forest.yml.gz", gray);
  EXPECT_EQ(cv::norm(expected, found, cv::NORM_INF), 0);
  EXPECT_GT(cv::countNonZero(found), 100);
}

TEST(Forest, DetectsLearnedOutlines) {
  const test::TempFolder temp;
  write_forest(temp / "forest.yml.gz", small_forest(1), small_shape());
  const Sample other = discs(9);
  const cv::Mat found = detected(temp / "forest.yml.gz", other.gray);
  EXPECT_GT(cv::mean(found, other.label)[0], 2 * cv::mean(found, other.label == 0)[0]);
}

TEST(Forest, TheSameSeedGivesTheSameFileAndAnotherSeedAnother) {
  const test::TempFolder temp;
  const auto bytes = [&](uint64_t seed) {
    write_forest(temp / "forest.yml", small_forest(seed), small_shape());
    return read_file(temp / "forest.yml", "");
  };
  const std::string once = bytes(3);
  EXPECT_EQ(bytes(3), once);
  EXPECT_NE(bytes(4), once);
}

TEST(Forest, AMissingFolderIsReported) {
  EXPECT_THROW(write_forest("/no/such/folder/forest.yml.gz", small_forest(1), small_shape()), InputError);
}

TEST(ForestLabels, ClassesSeparateTheMostDifferentLabels) {
  EdgePatch across, along;
  for (size_t i = 0; i < kInner; ++i) across[8 * kInner + i] = true, along[i * kInner + 8] = true;
  const std::vector<const EdgePatch*> patches{&across, &along, &across, &along, &along};
  Random random(1);
  const std::vector<uint8_t> classes = two_classes(patches, random);
  EXPECT_EQ(classes[0], classes[2]);
  EXPECT_EQ(classes[1], classes[3]);
  EXPECT_EQ(classes[1], classes[4]);
  EXPECT_NE(classes[0], classes[1]);
  EXPECT_EQ(most_typical(patches), along);  // three of five
}

TEST(TrainingSet, TheSameSeedGivesTheSamePiecesAndLabelsLieOnEdges) {
  Plan plan;
  plan.worlds = {{"desk", 5}};
  plan.frames = 2, plan.pieces = 2;
  const std::vector<Sample> once = make_samples(plan), again = make_samples(plan);
  ASSERT_EQ(once.size(), 4u);
  for (size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].gray.size(), cv::Size(320, 240));
    EXPECT_EQ(cv::norm(once[i].gray, again[i].gray, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(once[i].label, again[i].label, cv::NORM_INF), 0);
    EXPECT_GT(cv::countNonZero(once[i].label), 1000);
  }
  plan.seed = 2;
  EXPECT_NE(cv::norm(make_samples(plan)[0].gray, once[0].gray, cv::NORM_INF), 0);
  plan.lights = {"none"};  // as rendered: the gradient is strong where the labels are
  const Sample clean = make_samples(plan)[0];
  cv::Mat dx, dy, magnitude;
  cv::Sobel(clean.gray, dx, CV_32F, 1, 0);
  cv::Sobel(clean.gray, dy, CV_32F, 0, 1);
  cv::magnitude(dx, dy, magnitude);
  EXPECT_GT(cv::mean(magnitude, clean.label)[0], 4 * cv::mean(magnitude, clean.label == 0)[0]);
}

}  // namespace
}  // namespace edgevo::training
