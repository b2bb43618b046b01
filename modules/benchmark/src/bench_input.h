// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A sequence of a benchmark, opened anew for each of its jobs.
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

/// Opens a sequence of a list under its variants.
class BenchInput {
 public:
  /// Reads parameters and camera file, applies the settings of the variants as a check, and checks that the
  /// source exists. `data` is the folder to which sources are relative, `list` the file to which camera and
  /// parameter files are relative. Throws InputError prefixed with the line of the list.
  BenchInput(const BenchSequence& sequence, const std::string& data, const std::string& list);

  /// Opens the sequence under a variant; `seed` determines light changes and gaps. A scene is rendered once
  /// and kept for the lifetime of this object. Throws InputError.
  std::unique_ptr<ImageSource> open(const BenchVariant& variant, uint64_t seed, const BenchHost& host);
  /// Ground truth as the text of a TUM file; empty if there is none. Valid after open().
  const std::string& ground_truth() const { return ground_truth_; }

  /// Parameters with the variant's detector and settings. `edges` is the folder of precomputed edges; may be
  /// empty.
  RunParams params(const BenchVariant& variant, const std::string& edges) const;
  const BenchSequence& sequence() const { return sequence_; }
  /// Everything that a job's result depends on except the name of its variant and its seed, as YAML; includes
  /// the variant's settings.
  std::string description(const BenchVariant& variant) const;
  /// What a recorded sequence was taken for (ImageSource::decisions()); empty for a scene. Throws InputError.
  std::vector<InputDecision> decisions() const;
  /// Source for `edgevo edges`; empty for a scene.
  const std::string& source_path() const { return source_.path; }
  const std::string& camera_path() const { return source_.camera_file; }
  /// Name or file of the scene to render, with its frames; empty for a recorded sequence.
  std::string scene_key() const;
  /// Renders the scene into `folder` for all jobs (kept_clip.h). Throws InputError.
  void render_to(const std::string& folder, int threads);
  /// Uses the scene rendered into `folder`, if it exists, instead of rendering it.
  void take_scene_from(const std::string& folder) { kept_scene_ = folder; }
  /// Throws InputError if `out` is inside the source or contains it.
  void check_output(const std::string& out) const;
  /// Releases rendered images.
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
  /// Name or file of a scene; empty: the sequence is source_.
  std::string scene_;
  std::string camera_text_;
  RunParams params_;
  std::string ground_truth_;
  /// Rendered scene and its ground truth.
  std::shared_ptr<const Clip> clip_;
  std::string scene_truth_;
  /// Folder of the rendered scene; empty: none.
  std::string kept_scene_;
  /// Cached description of variants without settings, which are the majority.
  mutable std::string description_;
};

}  // namespace edgevo
