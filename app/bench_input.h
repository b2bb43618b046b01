#pragma once
// One sequence of a benchmark, opened again for each of its jobs.
#include <memory>
#include <string>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/evaluation/bench_list.h"
#include "edgevo/results/run_params.h"
#include "edgevo/simulation/clip.h"

namespace edgevo::app {

/// `data` is the folder that relative sources refer to, `list` the file that camera and parameter files stand beside.
class BenchInput {
 public:
  /// Reads parameters and camera file and looks whether the source is there, not more. Throws InputError that opens with the list's line.
  BenchInput(const BenchSequence& sequence, const std::string& data, const std::string& list);

  /// The sequence under a variant; light changes and gaps follow `seed`. A scene is rendered once, and kept while this lives. Throws InputError.
  std::unique_ptr<ImageSource> open(const BenchVariant& variant, uint64_t seed);
  /// Text of a TUM file; empty if there is none. After open().
  const std::string& ground_truth() const { return ground_truth_; }

  const RunParams& params() const { return params_; }
  const BenchSequence& sequence() const { return sequence_; }
  /// All that a job's result depends on but its variant and seed, as YAML.
  std::string description() const;
  /// Throws InputError when `out` lies in the source, or around it.
  void check_output(const std::string& out) const;
  /// Forgets rendered images.
  void release() { clip_.reset(); }

 private:
  std::unique_ptr<ImageSource> open_scene();
  std::unique_ptr<ImageSource> edited(ImageSource& source, const BenchVariant& variant, uint64_t seed);
  void render();

  BenchSequence sequence_;
  SourceOptions source_;
  std::string scene_;  ///< name or file of a scene; empty: source_ it is
  std::string camera_text_;
  RunParams params_;
  std::string ground_truth_;
  std::shared_ptr<const Clip> clip_;  ///< the scene, and its truth
  std::string scene_truth_;
};

}  // namespace edgevo::app
