// SPDX-License-Identifier: BSD-3-Clause
// Detectors that select edges by a probability: positions and number of edges, and rejected input.
#include "probable_edges.h"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/edges/canny.h"
#include "edgevo/edges/edge_extraction.h"
#include "edgevo/edges/frame_pyramid.h"
#include "support/temp_folder.h"
#include "support/test_images.h"
#include "support/tiny_forest.h"
#include "support/tiny_network.h"

namespace edgevo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::unique_ptr<EdgeDetector> detector_of(const EdgeParams& params) {
  return make_edge_detector(params, all_edge_detectors());
}
std::unique_ptr<EdgeProbability> probability_of(const EdgeParams& params) {
  return make_edge_probability(params, all_edge_detectors());
}

template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

// Model files and parameters that refer to them.
class ProbableDetectors : public ::testing::Test {
 protected:
  ProbableDetectors() {
    write_file(folder_ / "tiny.yml", test::forest_text(test::tiny_forest()));
    write_file(folder_ / "tiny.onnx", test::tiny_network());
    write_file(folder_ / "tiny.yaml", test::tiny_network_description());
  }
  EdgeParams params(const std::string& detector) const {
    EdgeParams p;
    p.detector = detector;
    p.folder = folder_.path();
    p.model = folder_ / (detector.find("structured") != std::string::npos ? "tiny.yml" : "tiny.onnx");
    return p;
  }
  // Edges of an image; the name is that of a probability image in the folder.
  ImageEdges edges_of(const GrayImage& image, const std::string& detector,
                      const std::string& name = "") const {
    const EdgeParams p = params(detector);
    const auto probability = probability_of(p);
    const Plane<uint8_t> likely = probability ? probability->estimate(image.view(), name) : Plane<uint8_t>();
    const Gradient gradient = compute_gradient(image.view());
    return extract_edges(detector_of(p)->detect({image.view(), gradient, likely.view()}), gradient,
                         p.min_chain);
  }
  void write_probability(const std::string& name, const GrayImage& image) const {
    cv::imwrite(folder_ / (name + ".png"),
                cv::Mat(image.height, image.width, CV_8UC1, const_cast<uint8_t*>(image.pixels.data())));
  }
  test::TempFolder folder_;
};

double deviation_from(const ImageEdges& map, const Eigen::Vector2d& on, const Eigen::Vector2d& n) {
  double square = 0;
  for (const EdgePixel& e : map.pixels) square += std::pow(n.dot(e.position().cast<double>() - on), 2);
  return std::sqrt(square / double(map.pixels.size()));
}

TEST_F(ProbableDetectors, LocateEdgesByTheGradient) {
  for (const double degrees : {0.0, 17.0, 45.0, 133.0, 290.0}) {
    const double a = degrees * M_PI / 180;
    const Eigen::Vector2d n(std::cos(a), std::sin(a)), on(60.3, 40.2);
    const GrayImage image = test::slanted_step(120, 80, on, n, 40, 200);
    for (const char* detector : {"structured", "network", "combined:structured", "combined:network"}) {
      const ImageEdges map = edges_of(image, detector);
      ASSERT_GT(map.pixels.size(), 40u) << detector << " " << degrees;
      EXPECT_LT(deviation_from(map, on, n), 0.1) << detector << " " << degrees;
    }
  }
}

// The ridge of the probability in the file lies two pixels next to the edge, and is wide.
TEST_F(ProbableDetectors, ARidgeNextToTheEdgeDoesNotMoveIt) {
  const Eigen::Vector2d n(std::cos(0.3), std::sin(0.3)), on(60.3, 40.2);
  const GrayImage image = test::slanted_step(120, 80, on, n, 40, 200);
  write_probability("a", test::make_image(120, 80, [&](double x, double y) {
                      return 200 *
                             std::exp(-0.5 * std::pow((n.dot(Eigen::Vector2d(x, y) - on) - 2) / 2.0, 2));
                    }));
  const ImageEdges map = edges_of(image, "precomputed", "a");
  ASSERT_GT(map.pixels.size(), 60u);
  EXPECT_LT(deviation_from(map, on, n), 0.1);
}

// Two steps of equal strength; the probability marks only the left one.
TEST_F(ProbableDetectors, TheProbabilitySelectsTheEdge) {
  const GrayImage image = test::make_image(160, 80, [](double x, double) {
    return x < 50 ? 40 : x < 110 ? 120 : 200;
  });
  write_probability("left",
                    test::make_image(160, 80, [](double x, double) { return x > 45 && x < 55 ? 230 : 0; }));
  for (const char* detector : {"precomputed", "combined:precomputed"}) {
    const ImageEdges map = edges_of(image, detector, "left");
    ASSERT_GT(map.pixels.size(), 60u) << detector;
    for (const EdgePixel& e : map.pixels) EXPECT_LT(e.x, 60) << detector;
  }
  EXPECT_GT(edges_of(image, "canny").pixels.size(), 140u) << "Canny finds both";
}

// Two lines: the probability of the upper one varies along it but is higher on average. Pixel by pixel, parts
// of both would be selected.
TEST(MostProbable, KeepsWholeChains) {
  const GrayImage image = test::make_image(160, 80, [](double, double y) {
    return y < 25 ? 40 : y < 55 ? 120 : 200;
  });
  const GrayImage likely = test::make_image(160, 80, [](double x, double y) {
    return y > 40 ? 140 : int(x) / 20 % 2 == 0 ? 230 : 90;
  });
  const Gradient gradient = compute_gradient(image.view());
  const Plane<uint8_t> candidates = canny(gradient, 30, 30);
  ASSERT_EQ(count_linked(candidates, 6), 2 * 156) << "two lines from border to border";
  const Plane<uint8_t> mask = most_probable(candidates, gradient, likely.view(), 150, 6);
  const ImageEdges map = extract_edges(mask, gradient, 6);
  EXPECT_EQ(map.chains.size(), 1u);
  EXPECT_EQ(map.pixels.size(), 156u) << "the chain that reaches the budget stays complete";
  for (const EdgePixel& e : map.pixels) EXPECT_LT(e.y, 40);
}

TEST_F(ProbableDetectors, RequireAProbability) {
  const GrayImage image = test::textured_image(120, 80, 3);
  const Gradient gradient = compute_gradient(image.view());
  for (const char* detector : {"network", "combined:network"})
    EXPECT_THAT(error_of([&] {
                  detector_of(params(detector))->detect({image.view(), gradient});
                }),
                HasSubstr("needs a probability"))
        << detector;
}

TEST_F(ProbableDetectors, ZeroProbabilityGivesNoEdge) {
  const GrayImage image = test::textured_image(120, 80, 3);
  write_probability("none", test::make_image(120, 80, [](double, double) { return 0; }));
  EXPECT_TRUE(edges_of(image, "precomputed", "none").pixels.empty());
  EXPECT_TRUE(edges_of(image, "combined:precomputed", "none").pixels.empty());
}

// Only the order of the probabilities counts: a third of them gives the same edges.
TEST_F(ProbableDetectors, DoNotDependOnTheScaleOfProbabilities) {
  const GrayImage image = test::textured_image(240, 160, 5);
  const auto probability = probability_of(params("network"))->estimate(image.view(), "");
  const auto share = [&](int divisor) {
    return test::make_image(
        240, 160, [&](double x, double y) { return double(probability.at(int(x), int(y)) / divisor); });
  };
  write_probability("whole", share(1));
  write_probability("third", share(3));
  for (const char* detector : {"precomputed", "combined:precomputed"}) {
    const double whole = double(edges_of(image, detector, "whole").pixels.size()),
                 third = double(edges_of(image, detector, "third").pixels.size());
    ASSERT_GT(whole, 500) << detector;
    EXPECT_NEAR(third / whole, 1, 0.1) << detector;
  }
}

// The number of edges is that of Canny, also when the light falls.
TEST_F(ProbableDetectors, GiveAboutAsManyEdgesAsCanny) {
  const test::Texture texture(7);
  for (const double gain : {1.0, 0.4}) {
    const GrayImage image = test::make_image(240, 160, [&](double x, double y) {
      return gain * texture.at({x, y});
    });
    const double canny = double(edges_of(image, "canny").pixels.size());
    for (const char* detector : {"structured", "network", "combined:structured", "combined:network"}) {
      const double count = double(edges_of(image, detector).pixels.size());
      EXPECT_GT(count / canny, 0.9) << detector << " " << gain;
      EXPECT_LT(count / canny, 1.1) << detector << " " << gain;
    }
  }
}

TEST_F(ProbableDetectors, AreDeterministic) {
  const GrayImage image = test::textured_image(121, 83, 9);
  for (const char* detector : {"structured", "network"}) {
    const auto first = probability_of(params(detector)), second = probability_of(params(detector));
    const Plane<uint8_t> a = first->estimate(image.view(), ""), b = second->estimate(image.view(), ""),
                         c = first->estimate(image.view(), "");
    EXPECT_TRUE(std::equal(a.row(0), a.row(0) + 121 * 83, b.row(0))) << detector;
    EXPECT_TRUE(std::equal(a.row(0), a.row(0) + 121 * 83, c.row(0))) << detector;
  }
}

// For any number of OpenCV's threads. Four comes first: with TBB, one would become the limit of the process.
TEST_F(ProbableDetectors, DoNotDependOnThreads) {
  const GrayImage image = test::textured_image(321, 203, 11);
  const int before = cv::getNumThreads();
  std::vector<Plane<uint8_t>> found;
  for (const int threads : {4, 1}) {
    cv::setNumThreads(threads);
    for (const char* detector : {"structured", "network"})
      found.push_back(probability_of(params(detector))->estimate(image.view(), ""));
  }
  cv::setNumThreads(before);
  for (size_t i = 0; i < 2; ++i)
    EXPECT_TRUE(std::equal(found[i].row(0), found[i].row(0) + 321 * 203, found[i + 2].row(0))) << i;
}

// Smaller than a patch, odd, one pixel: no crash and no spurious edge.
TEST_F(ProbableDetectors, AcceptImagesOfAnySize) {
  for (const char* detector : {"structured", "network", "combined:network"})
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(2, 9), std::pair(7, 5), std::pair(33, 17)})
      EXPECT_TRUE(edges_of(test::make_image(width, height, [](double, double) { return 77; }), detector)
                      .pixels.empty())
          << detector << " " << width << "x" << height;
}

// Probabilities from a file and computed ones give the same edges, on all levels and with a lens.
TEST_F(ProbableDetectors, FilesGiveTheSameEdgesAsTheDetector) {
  Camera camera;
  camera.set_pinhole({150, 150, 120, 80, 240, 160});
  camera.set_distortion({-0.2, 0, 0, 0, 0});
  const GrayImage image = test::textured_image(240, 160, 13);
  const auto probability = probability_of(params("network"))->estimate(image.view(), "");
  write_probability("000007", test::make_image(240, 160, [&](double x, double y) {
                      return double(probability.at(int(x), int(y)));
                    }));
  Frame frame;
  frame.index = 7;
  frame.image = image;
  PyramidBuilder live(camera, params("network"), all_edge_detectors()),
      files(camera, params("precomputed"), all_edge_detectors());
  const auto a = live.build(frame), b = files.build(frame);
  const auto again =
      PyramidBuilder::for_rebuilding(camera, params("network"), all_edge_detectors()).rebuild(*a);
  for (size_t l = 0; l < 2; ++l) {
    const auto& expected = a->levels[l].edges.pixels;
    ASSERT_GT(expected.size(), 100u) << l;
    for (const auto& other : {b, again}) {
      const auto& got = other->levels[l].edges.pixels;
      ASSERT_EQ(got.size(), expected.size()) << l;
      for (size_t i = 0; i < got.size(); ++i) ASSERT_EQ(got[i].position(), expected[i].position()) << l;
    }
  }
}

// ---- rejected input ----

TEST_F(ProbableDetectors, RejectAnInvalidModel) {
  write_file(folder_ / "text.onnx", "no network");
  write_file(folder_ / "text.yaml", test::tiny_network_description());
  EdgeParams p = params("network");
  p.model = folder_ / "text.onnx";
  EXPECT_THAT(error_of([&] { probability_of(p); }), HasSubstr("not a usable network"));
  write_file(p.model, test::tiny_network().substr(0, 150));
  EXPECT_THAT(error_of([&] { probability_of(p); }), HasSubstr("not a usable network"));
  p.model = folder_ / "missing.onnx";
  EXPECT_NE(error_of([&] { probability_of(p); }), "");
  p = params("structured");
  p.model = folder_ / "tiny.onnx";
  EXPECT_THAT(error_of([&] { probability_of(p); }), HasSubstr("not a structured forest"));
}

TEST_F(ProbableDetectors, RejectADescriptionThatDoesNotFit) {
  const GrayImage image = test::textured_image(40, 30, 1);
  const auto with = [&](const std::string& description) {
    write_file(folder_ / "tiny.yaml", description);
    return error_of([&] { probability_of(params("network"))->estimate(image.view(), ""); });
  };
  EXPECT_EQ(with(test::tiny_network_description()), "");
  EXPECT_EQ(with("input: image\noutput: edges\nsize: fixed 48x40\n"), "") << "a smaller image is extended";
  EXPECT_THAT(with("input: image\noutput: edges\nszie: fixed 48x40\n"),
              AllOf(HasSubstr("szie"), HasSubstr("size")));
  EXPECT_THAT(with("input: image\noutput: ridges\n"), HasSubstr("'ridges'"));
  EXPECT_THAT(with("input: picture\noutput: edges\n"), HasSubstr("'picture'"));
  EXPECT_THAT(with("input: image\noutput: edges\nsize: fixed 32x30\n"),
              HasSubstr("takes images of 32x30, not of 40x30"));
  for (const char* size :
       {"fixed", "fixed 0x5", "fixed 5", "multiple_of 0", "multiple_of x", "any", "fixed 4x4 4"})
    EXPECT_THAT(with(std::string("input: image\noutput: edges\nsize: ") + size + "\n"), HasSubstr("size"))
        << size;
  EXPECT_THAT(with("input: image\noutput: edges\nmean: 1 2\n"), HasSubstr("mean"));
  EXPECT_THAT(with("input: image\noutput: edges\nstd: 0\n"), HasSubstr("std"));
  EXPECT_THAT(with("input: image\noutput: edges\nchannels: rgb\n"), HasSubstr("does not work"))
      << "the network has one input channel";
}

TEST_F(ProbableDetectors, RejectANetworkWithAnotherOutputSize) {
  write_file(folder_ / "tiny.onnx", test::tiny_network(2));
  const GrayImage image = test::textured_image(40, 32, 1);
  EXPECT_THAT(error_of([&] { probability_of(params("network"))->estimate(image.view(), ""); }),
              HasSubstr("gives 1x1x16x20 for an image of 1x1x32x40"));
}

TEST_F(ProbableDetectors, RejectFilesThatDoNotFit) {
  const GrayImage image = test::textured_image(40, 30, 1);
  const auto reading = [&](const std::string& name) {
    return error_of([&] { probability_of(params("precomputed"))->estimate(image.view(), name); });
  };
  write_probability("good", image);
  EXPECT_EQ(reading("good"), "");
  EXPECT_THAT(reading("missing"), HasSubstr("missing.png"));
  write_probability("small", test::textured_image(39, 30, 1));
  EXPECT_THAT(reading("small"), HasSubstr("is 39x30, the image 40x30"));
  write_file(folder_ / "text.png", "no image");
  EXPECT_THAT(reading("text"), HasSubstr("text.png"));
  cv::imwrite(folder_ / "colour.png", cv::Mat(30, 40, CV_8UC3, cv::Scalar(1, 2, 3)));
  EXPECT_THAT(reading("colour"), HasSubstr("one channel"));
  EdgeParams p = params("precomputed");
  p.folder = "";
  EXPECT_THAT(error_of([&] { probability_of(p); }), HasSubstr("edges.folder"));
  p.folder = folder_ / "nowhere";
  EXPECT_THAT(error_of([&] { probability_of(p); }), HasSubstr("is not a folder"));
}

// Sixteen bits are accepted too.
TEST_F(ProbableDetectors, AcceptFilesOfSixteenBits) {
  cv::imwrite(folder_ / "deep.png", cv::Mat(30, 40, CV_16UC1, cv::Scalar(32768)));
  const GrayImage image = test::textured_image(40, 30, 1);
  EXPECT_EQ(probability_of(params("precomputed"))->estimate(image.view(), "deep").at(3, 3), 128);
}

}  // namespace
}  // namespace edgevo
