// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// COLMAP's camera models, by the names of cameras.txt and by the numbers of cameras.bin and database.db
// (colmap.github.io/cameras.html, format.html). The corner of the image is 0 there, here the centre of its
// first pixel.
#include <optional>
#include <string>
#include <vector>

#include "dialect.h"

namespace edgevo {

/// A camera as COLMAP states it.
struct ColmapCamera {
  /// Number of the model, or -1 with its name.
  int model = -1;
  std::string model_name;
  double width = 0, height = 0;
  std::vector<double> params;
};

/// Number of parameters of a model; nullopt if there is no such number.
std::optional<size_t> colmap_params(int model);

/// The names of the models, in the order of their numbers.
std::vector<std::string> colmap_model_names();

/// Throws InputError for a model that is not supported, a wrong number of parameters or a size that is none.
CameraText colmap_camera(const ColmapCamera& camera, const std::string& where);

}  // namespace edgevo
