#pragma once
// What detectors are trained on: pieces of rendered frames under changed light, with the edges to be found.
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

/// What counts as an edge: the true ones that the clean image shows (simulation/true_edge_labels.h), or those
/// that a run in changing light found again (lasting_edges.h).
enum class Label { kTrue, kLasting };

struct Plan {
  std::vector<World> worlds;
  Label label = Label::kTrue;
  int frames = 10;                ///< of each world (lasting: of its keyframes), at equal steps
  int pieces = 3;                 ///< of each frame, each in other light
  int width = 320, height = 240;  ///< of a piece, pixels
  uint64_t seed = 1;
  /// Empty: any light, with blur, noise and JPEG. Else kinds of relight, or "none" for the image as rendered:
  /// a piece of each in each of these, nothing added.
  std::vector<std::string> lights = {};
};

/// "train": the worlds to train on, with their true edges; "lasting": the same with edges that last; "test":
/// those that are kept for the test, with their true edges. Throws InputError for another word.
Plan plan_named(const std::string& name);

struct Sample {
  cv::Mat gray;   ///< CV_8U, as a camera would give it
  cv::Mat label;  ///< CV_8U, not 0: an edge (Label::kTrue: of which kind, TrueEdge)
};

/// Samples by world, frame and piece. Throws InputError for a scene that is not there, and for one whose run
/// has no keyframe. Cost: about 0.5 s a frame; of lasting edges one run through each world before.
std::vector<Sample> make_samples(const Plan& plan);

/// "edgevo training set 1\nCOUNT WIDTH HEIGHT\n", then for each sample the bytes of the image and of the
/// label. Throws InputError.
void write_samples(const std::string& path, const std::vector<Sample>& samples);

}  // namespace edgevo::training
