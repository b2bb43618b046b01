// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/edge_extraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/edges/edge_detector.h"
#include "edgevo/edges/frame_pyramid.h"
#include "support/test_images.h"

namespace edgevo {
namespace {

using test::disc_image;
using test::slanted_step;

ImageEdges edges_of(const GrayImage& image) {
  const EdgeParams params;
  const Gradient gradient = compute_gradient(image.view());
  return extract_edges(make_edge_detector(params)->detect({image.view(), gradient}), gradient,
                       params.min_chain);
}

// A blurred straight edge through (60.3, 40.2): every edge pixel must lie on it to sub-pixel, with the right
// normal.
TEST(EdgeExtraction, StraightEdgesAreSubPixelAndPointFromDarkToBright) {
  for (double degrees : {0.0, 17.0, 45.0, 90.0, 133.0, 200.0, 301.0}) {
    const double a = degrees * M_PI / 180;
    const Eigen::Vector2d n(std::cos(a), std::sin(a)), on(60.3, 40.2);
    const ImageEdges map = edges_of(slanted_step(120, 80, on, n, 40, 200));
    ASSERT_GT(map.pixels.size(), 40u) << degrees;
    double square = 0;
    for (const EdgePixel& e : map.pixels) {
      square += std::pow(n.dot(e.position().cast<double>() - on), 2);
      EXPECT_GT(e.normal().cast<double>().dot(n), 0.99) << degrees;
    }
    EXPECT_LT(std::sqrt(square / double(map.pixels.size())), 0.1) << degrees;
  }
}

// A pixel marked next to a maximum of the gradient is not moved: a parabola that opens upwards has no
// maximum. The gray levels increase by one, then two, then four per pixel from left to right.
TEST(EdgeExtraction, PixelsWithoutAMaximumAreNotMoved) {
  const GrayImage image = test::make_image(90, 40, [](double x, double) {
    return x < 30 ? x : x < 60 ? 30 + 2 * (x - 30) : 90 + 4 * (x - 60);
  });
  const Gradient gradient = compute_gradient(image.view());
  for (const int column : {15, 28, 57}) {
    Plane<uint8_t> mask(90, 40);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 90; ++x) mask.at(x, y) = x == column ? 255 : 0;
    const ImageEdges map = extract_edges(mask, gradient, 5);
    ASSERT_EQ(map.chains.size(), 1u) << column;
    for (const EdgePixel& e : map.pixels) EXPECT_EQ(e.x, float(column));
  }
}

TEST(EdgeExtraction, ChainsFollowTheEdge) {
  const ImageEdges map = edges_of(disc_image(121, 91, {60.2, 44.7}, 30, 60, 190));
  ASSERT_FALSE(map.chains.empty());
  int total = 0, longest = 0;
  for (size_t c = 0; c < map.chains.size(); ++c) {
    const EdgeChain& chain = map.chains[c];
    EXPECT_GE(chain.length(), 6);
    total += chain.length();
    longest = std::max(longest, chain.length());
    for (int i = chain.begin; i < chain.end; ++i) {
      EXPECT_EQ(map.pixels[i].chain, int(c));
      const int next = map.neighbour(i, +1);
      EXPECT_EQ(next, i + 1 < chain.end ? i + 1 : -1);
      if (next >= 0) {
        EXPECT_LT((map.pixels[next].position() - map.pixels[i].position()).norm(), 2.3f);
      }
    }
  }
  EXPECT_EQ(total, int(map.pixels.size()));
  EXPECT_GT(longest, 140) << "a circle of radius 30 is one edge of about 170 pixels";
}

TEST(EdgeExtraction, EdgesAreThin) {
  const ImageEdges map = edges_of(disc_image(121, 91, {60.2, 44.7}, 30, 60, 190));
  EXPECT_LT(map.pixels.size(), size_t(2 * M_PI * 30 * 1.05));
}

// The number of edge pixels must not follow the exposure.
TEST(EdgeExtraction, EdgeCountIsSteadyUnderGain) {
  GrayImage image = test::textured_image(320, 240, 3);
  const size_t normal = edges_of(image).pixels.size();
  for (uint8_t& v : image.pixels) v = uint8_t(0.4 * v);
  const size_t dark = edges_of(image).pixels.size();
  ASSERT_GT(normal, 500u);
  EXPECT_NEAR(double(dark), double(normal), 0.15 * double(normal));
}

// If many pixels share the strongest gradient, the percentile is the maximum itself; the stripes must still
// be found.
TEST(EdgeExtraction, EqualStripesAreFound) {
  const GrayImage stripes =
      test::make_image(160, 120, [](double x, double) { return 128 + 90 * std::sin(x / 2.5); });
  EXPECT_GT(edges_of(stripes).pixels.size(), 1000u);
}

TEST(EdgeExtraction, DegenerateImagesHaveNoEdges) {
  for (const auto& [w, h] : {std::pair{1, 1}, {3, 3}, {5, 4}, {101, 1}, {1, 77}, {64, 48}}) {
    GrayImage blank{w, h, std::vector<uint8_t>(size_t(w) * h, 130)};
    EXPECT_TRUE(edges_of(blank).pixels.empty()) << w << "x" << h;
  }
}

TEST(EdgeDetectors, TheDefaultIsAvailable) {
  EXPECT_EQ(edge_detector_names().front(), EdgeParams().detector);
  EXPECT_EQ(basic_edge_detectors().front().name, EdgeParams().detector);
}

TEST(EdgeDetectors, ADetectorMissingFromTheTableIsReported) {
  EdgeParams params;
  params.detector = "network";
  for (const auto& make : {+[](const EdgeParams& p) { make_edge_detector(p); },
                           +[](const EdgeParams& p) { make_edge_probability(p); }}) {
    try {
      make(params);
      FAIL();
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("without the detector 'network'"), std::string::npos);
    }
  }
}

TEST(EdgeDetectors, AProgramCanAddItsOwn) {
  EdgeDetectorTable table = basic_edge_detectors();
  table.push_back({"mine", "Canny by another name", table.front().make});
  EdgeParams params;
  params.detector = "mine";
  EXPECT_NE(make_edge_detector(params, table), nullptr);
  EXPECT_EQ(make_edge_probability(params, table), nullptr);
  EXPECT_EQ(edge_detector_help({table.back()}), "mine (Canny by another name)");
}

TEST(EdgeExtraction, AnUnknownDetectorIsReportedWithTheNearestName) {
  EdgeParams params;
  params.detector = "cany";
  try {
    make_edge_detector(params);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("canny"), std::string::npos);
  }
}

TEST(FramePyramid, LevelsHalveInSizeAndTheFinestHaveEdges) {
  Camera camera;
  camera.set_pinhole({200, 200, 80, 60, 161, 121});
  PyramidBuilder builder(camera, EdgeParams());
  const auto pyramid = builder.build(test::textured_image(161, 121, 5));
  ASSERT_EQ(pyramid->levels.size(), 4u);
  EXPECT_EQ(pyramid->levels[1].gray.width(), 81);
  EXPECT_EQ(pyramid->levels[3].gray.height(), 16);
  EXPECT_DOUBLE_EQ(pyramid->levels[2].pinhole.fx, 50);
  EXPECT_FALSE(pyramid->levels[1].edges.pixels.empty());
  EXPECT_TRUE(pyramid->levels[2].edges.pixels.empty());
}

TEST(FramePyramid, RejectsAnImageOfAnotherSize) {
  Camera camera;
  camera.set_pinhole({200, 200, 80, 60, 160, 120});
  PyramidBuilder builder(camera, EdgeParams());
  EXPECT_THROW(builder.build(test::textured_image(161, 120, 5)), InputError);
}

// A distorted straight edge is straight again in the pyramid.
TEST(FramePyramid, RemovesTheDistortion) {
  Camera camera;
  camera.set_pinhole({300, 300, 160, 120, 320, 240});
  camera.set_distortion({-0.3, 0, 0, 0, 0});
  GrayImage image{320, 240, std::vector<uint8_t>(320 * 240)};
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) {
      const auto ray = camera.unproject({double(u), double(v)});
      ASSERT_TRUE(ray);
      const double distance =
          300 * ray->x() / ray->z() + 160 - 60.0;  // the line u = 60 of the undistorted image
      image.pixels[size_t(v) * 320 + u] = uint8_t(120 + 80 * std::tanh(distance));
    }
  PyramidBuilder builder(camera, EdgeParams());
  const auto pyramid = builder.build(image);
  const ImageEdges& edges = pyramid->finest().edges;
  int on_line = 0;
  for (const EdgePixel& e : edges.pixels)
    if (std::abs(e.x - 60) < 3) {
      EXPECT_NEAR(e.x, 60, 0.25);
      ++on_line;
    }
  EXPECT_GT(on_line, 150);
}

// Every pixel is the bilinear value at its position in the map up to rounding: half a gray level, and 1/256
// px of the slope along each axis.
TEST(FramePyramid, UndistortsToTheRoundingOfItsPositions) {
  Camera camera;
  camera.set_pinhole({300, 300, 160, 120, 320, 240});
  camera.set_distortion({0.2, 0, 0, 0, 0});  // the corners are sampled outside the image
  const GrayImage image = test::textured_image(320, 240, 5);
  const auto pyramid = PyramidBuilder(camera, EdgeParams()).build(image);
  const RectificationMaps maps = Rectification(camera).maps();
  int beyond = 0;
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) {
      const size_t i = size_t(v) * 320 + u;
      const double x = std::clamp(double(maps.x[i]), 0.0, 319.0),
                   y = std::clamp(double(maps.y[i]), 0.0, 239.0);
      beyond += x != maps.x[i] || y != maps.y[i];
      const int left = std::min(int(x), 318), top = std::min(int(y), 238);
      const double a = image.view().at(left, top), b = image.view().at(left + 1, top),
                   c = image.view().at(left, top + 1), d = image.view().at(left + 1, top + 1), fx = x - left,
                   fy = y - top;
      const double exact = (a * (1 - fx) + b * fx) * (1 - fy) + (c * (1 - fx) + d * fx) * fy;
      const double slope = std::max({a, b, c, d}) - std::min({a, b, c, d});
      ASSERT_NEAR(pyramid->finest().gray.at(u, v), exact, 0.501 + slope * 2 / 256) << u << " " << v;
    }
  EXPECT_GT(beyond, 1000);
}

}  // namespace
}  // namespace edgevo
