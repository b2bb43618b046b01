#pragma once
// What detectors are trained on: pieces of rendered frames under changed light, with their true edges.
//
// The worlds are other ones than those of datasets/scenes and of the benchmarks (other seeds); corridor is
// held out as a kind. Everything follows from the seed: the same plan gives the same bytes.
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace edgevo::training {

struct World {
  const char* scene;  ///< a name of datasets/scenes
  uint64_t seed;
};

struct Plan {
  std::vector<World> worlds;
  int frames = 10;                ///< of each world, at equal steps
  int pieces = 3;                 ///< of each frame, each in other light
  int width = 320, height = 240;  ///< of a piece, pixels
  uint64_t seed = 1;
  /// Empty: any light, with blur, noise and JPEG. Else kinds of relight, or "none" for the image as rendered:
  /// a piece of each in each of these, nothing added.
  std::vector<std::string> lights = {};
};

/// The worlds to train on, and those that are kept for the test.
Plan training_plan();
Plan test_plan();

struct Sample {
  cv::Mat gray;   ///< CV_8U, as a camera would give it
  cv::Mat label;  ///< CV_8U, TrueEdge; edges that the clean image does not show are left out
};

/// Samples by world, frame and piece. Throws InputError for a scene that is not there. Cost: about 0.5 s a
/// frame.
std::vector<Sample> make_samples(const Plan& plan);

/// "edgevo training set 1\nCOUNT WIDTH HEIGHT\n", then for each sample the bytes of the image and of the
/// label. Throws InputError.
void write_samples(const std::string& path, const std::vector<Sample>& samples);

}  // namespace edgevo::training
