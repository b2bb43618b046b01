// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rendered scene shared by the jobs of a benchmark: a folder as written by `edgevo simulate`, and clip.yaml
// with the values that the folder rounds, so that a job gets exactly what it would have rendered itself.
#include <memory>
#include <string>

#include "edgevo/simulation/clip.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

/// Renders frames begin <= index < end into `folder` on `threads` threads; `kind` is that of the clip.
/// clip.yaml is written last. Throws InputError.
void keep_clip(const SceneRenderer& renderer, int begin, int end, const std::string& kind, int threads,
               const std::string& folder);

/// Whether the folder exists and is complete.
bool is_kept_clip(const std::string& folder);

/// Reads the clip of a folder and the text of its ground truth. Throws InputError.
std::shared_ptr<const Clip> read_kept_clip(const std::string& folder, std::string* ground_truth);

}  // namespace edgevo
