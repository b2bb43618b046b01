#pragma once
// What the programs for tables are asked on the command line: SCENE SEED [LIGHT | -] [frames=N]
// [GROUP.KEY=VALUE...], and words of their own.
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
  std::string scene, light = "-";  ///< "-": as it is
  uint64_t seed = 1;
  int frames = -1;  ///< the first ones; -1: all
  OdometryParams params;
};

/// Fills `request`. `own` takes NAME and VALUE of the program's own words NAME=VALUE, and returns false for
/// others. Throws InputError (`usage`).
void parse_figures_request(const std::vector<std::string>& args, const std::string& usage,
                           const std::function<bool(const std::string& name, const std::string& value)>& own,
                           FiguresRequest* request);

/// The frames that are asked for, relit where a light is named.
std::unique_ptr<ImageSource> images_of(const FiguresRequest& request,
                                       const std::shared_ptr<const SceneRenderer>& renderer);

}  // namespace edgevo::test
