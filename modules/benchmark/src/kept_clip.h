#pragma once
// A rendered scene that the jobs of a benchmark share: a folder as `edgevo simulate` writes it, and clip.yaml
// with what such a folder does not hold to the last digit, so that a job gets what it would have rendered
// itself.
#include <memory>
#include <string>

#include "edgevo/simulation/clip.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

/// Renders frames begin <= index < end into `folder`, on so many threads; `kind` is the clip's. clip.yaml is
/// written last. Throws InputError.
void keep_clip(const SceneRenderer& renderer, int begin, int end, const std::string& kind, int threads,
               const std::string& folder);

/// The folder is there and complete.
bool is_kept_clip(const std::string& folder);

/// Gives the text of its ground truth, too. Throws InputError.
std::shared_ptr<const Clip> read_kept_clip(const std::string& folder, std::string* ground_truth);

}  // namespace edgevo
