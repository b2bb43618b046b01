// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/detectors/all_detectors.h"

#include <gmock/gmock.h>

#include "edgevo/edges/edge_extraction.h"
#include "support/test_images.h"

namespace edgevo {
namespace {

// Uses a probability, for detectors that need one, that is high wherever there is a gradient.
ImageEdges edges_of(const GrayImage& image, const std::string& detector) {
  EdgeParams params;
  params.detector = detector;
  const Gradient gradient = compute_gradient(image.view());
  const GrayImage likely = test::make_image(
      image.width, image.height, [&](double x, double y) { return gradient.magnitude.at(int(x), int(y)); });
  return extract_edges(
      make_edge_detector(params, all_edge_detectors())->detect({image.view(), gradient, likely.view()}),
      gradient, params.min_chain);
}

TEST(AllDetectors, EdgeDrawingFindsTheSameCircle) {
  const ImageEdges map = edges_of(test::disc_image(121, 91, {60.2, 44.7}, 30, 60, 190), "edge_drawing");
  ASSERT_GT(map.pixels.size(), 120u);
  for (const EdgePixel& e : map.pixels)
    EXPECT_NEAR((e.position().cast<double>() - Eigen::Vector2d(60.2, 44.7)).norm(), 30, 0.6);
}

TEST(AllDetectors, EachIsMadeByName) {
  const GrayImage image = test::disc_image(121, 91, {60.2, 44.7}, 30, 60, 190);
  const std::string help = edge_detector_help(all_edge_detectors());
  for (const EdgeDetectorKind& kind : all_edge_detectors()) {
    EXPECT_FALSE(edges_of(image, kind.name).pixels.empty()) << kind.name;
    EXPECT_THAT(help, ::testing::HasSubstr(std::string(kind.name) + " (" + kind.what + ")"));
  }
}

// The valid values of the parameter are the available detectors.
TEST(AllDetectors, AreTheValuesOfTheParameter) {
  std::vector<std::string> names;
  for (const EdgeDetectorKind& kind : all_edge_detectors()) names.emplace_back(kind.name);
  EXPECT_EQ(names, edge_detector_names());
}

}  // namespace
}  // namespace edgevo
