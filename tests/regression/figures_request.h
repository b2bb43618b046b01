// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Command line of the programs that make tables: SCENE SEED [LIGHT | -] [frames=N] [GROUP.KEY=VALUE...], and
// arguments of their own.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "edgevo/core/image_source.h"
#include "edgevo/odometry/odometry_params.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo::test {

struct FiguresRequest {
  /// Name of a scene or a YAML file.
  std::string scene;
  /// Kind of lighting change, as of `edgevo relight`; "-": none.
  std::string light = "-";
  uint64_t seed = 1;
  /// Number of frames to use, from the first one; -1: all.
  int frames = -1;
  OdometryParams params;
};

/// Fills `request`. `own` takes NAME and VALUE of the program's own arguments NAME=VALUE, and returns false
/// for others. Throws InputError with `usage`.
void parse_figures_request(const std::vector<std::string>& args, const std::string& usage,
                           const std::function<bool(const std::string& name, const std::string& value)>& own,
                           FiguresRequest* request);

/// The requested frames, relit where a lighting change is requested.
std::unique_ptr<ImageSource> images_of(const FiguresRequest& request,
                                       const std::shared_ptr<const SceneRenderer>& renderer);

}  // namespace edgevo::test
