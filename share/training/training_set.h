// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Training data of detectors: pieces of rendered frames in changed light, with their edges.
//
// The worlds differ from those of datasets/scenes and of the benchmarks (other seeds); corridor is held out
// altogether. Everything depends on the seed only: the same plan gives the same bytes.
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace edgevo::training {

/// A rendered scene.
struct World {
  /// Name in datasets/scenes.
  const char* scene;
  uint64_t seed;
};

/// Definition of an edge: true edges visible in the clean image (simulation/true_edge_labels.h), or edges
/// that a run in changing light found again (lasting_edges.h).
enum class Label { kTrue, kLasting };

/// Specification of a training set.
struct Plan {
  std::vector<World> worlds;
  Label label = Label::kTrue;
  /// Number of frames of each world (lasting: of its keyframes), at equal steps.
  int frames = 10;
  /// Number of pieces of each frame, each in different light.
  int pieces = 3;
  /// Size of a piece, pixels.
  int width = 320, height = 240;
  uint64_t seed = 1;
  /// If empty, random light with blur, noise and JPEG. Otherwise kinds of relight, or "none" for the image as
  /// rendered: each piece appears in each of these, with nothing added.
  std::vector<std::string> lights = {};
};

/// Plan by name: "train" has the training worlds with true edges, "lasting" the same with lasting edges,
/// "test" the held-out worlds with true edges. Throws InputError for another name.
Plan plan_named(const std::string& name);

/// One piece with its label.
struct Sample {
  /// Gray image, CV_8U, as from a camera.
  cv::Mat gray;
  /// Label image, CV_8U, nonzero at edge pixels (with Label::kTrue the kind of edge, TrueEdge).
  cv::Mat label;
};

/// Renders the samples in order of world, frame and piece. Throws InputError for a missing scene, and for one
/// whose run has no keyframe. Cost: about 0.5 s per frame; lasting edges need one run through each world
/// first.
std::vector<Sample> make_samples(const Plan& plan);

/// Writes "edgevo training set 1\nCOUNT WIDTH HEIGHT\n", then for each sample the bytes of the image and of
/// the label. Throws InputError.
void write_samples(const std::string& path, const std::vector<Sample>& samples);

}  // namespace edgevo::training
