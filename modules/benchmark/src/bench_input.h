#pragma once
// One sequence of a benchmark, opened again for each of its jobs.
#include <memory>
#include <string>

#include "edgevo/benchmark/bench_host.h"
#include "edgevo/benchmark/bench_list.h"
#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/results/run_params.h"
#include "edgevo/simulation/clip.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

/// `data` is the folder that relative sources refer to, `list` the file that camera and parameter files stand
/// beside.
class BenchInput {
 public:
  /// Reads parameters and camera file, tries the settings of the variants, and looks whether the source is
  /// there, not more. Throws InputError that opens with the list's line.
  BenchInput(const BenchSequence& sequence, const std::string& data, const std::string& list);

  /// The sequence under a variant; light changes and gaps follow `seed`. A scene is rendered once, and kept
  /// while this lives. Throws InputError.
  std::unique_ptr<ImageSource> open(const BenchVariant& variant, uint64_t seed, const BenchHost& host);
  /// Text of a TUM file; empty if there is none. After open().
  const std::string& ground_truth() const { return ground_truth_; }

  /// With the variant's detector and settings. `edges`: the folder of those that were computed before; empty
  /// where there are none.
  RunParams params(const BenchVariant& variant, const std::string& edges) const;
  const BenchSequence& sequence() const { return sequence_; }
  /// All that a job's result depends on but its variant and seed, as YAML; with the variant's settings.
  std::string description(const BenchVariant& variant) const;
  /// What `edgevo edges` is given; empty for a scene.
  const std::string& source_path() const { return source_.path; }
  const std::string& camera_path() const { return source_.camera_file; }
  /// Name or file of the scene, with its frames: what is to be rendered. Empty: it is recorded.
  std::string scene_key() const;
  /// Renders the scene into `folder`, from where other jobs take it (kept_clip.h). Throws InputError.
  void render_to(const std::string& folder, int threads);
  /// The scene lies in `folder`, if it is there; it is not rendered then.
  void take_scene_from(const std::string& folder) { kept_scene_ = folder; }
  /// Throws InputError when `out` lies in the source, or around it.
  void check_output(const std::string& out) const;
  /// Forgets rendered images.
  void release() { clip_.reset(); }

 private:
  RunParams with_settings(const BenchVariant& variant) const;
  std::unique_ptr<ImageSource> open_scene(const BenchHost& host);
  std::unique_ptr<ImageSource> edited(ImageSource& source, const BenchVariant& variant, uint64_t seed,
                                      const BenchHost& host);
  void render(const BenchHost& host);
  std::shared_ptr<const SceneRenderer> renderer() const;

  BenchSequence sequence_;
  SourceOptions source_;
  std::string scene_;  ///< name or file of a scene; empty: source_ it is
  std::string camera_text_;
  RunParams params_;
  std::string ground_truth_;
  std::shared_ptr<const Clip> clip_;  ///< the scene, and its truth
  std::string scene_truth_;
  std::string kept_scene_;  ///< folder; empty: none
  /// Once it was asked for: of a variant without settings, as most are.
  mutable std::string description_;
};

}  // namespace edgevo
