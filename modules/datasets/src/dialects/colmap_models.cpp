// SPDX-License-Identifier: BSD-3-Clause
#include "colmap_models.h"

#include <algorithm>

#include "camera_numbers.h"
#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

struct ColmapModel {
  const char* name;
  /// f or fx, fy; then cx, cy; then the coefficients.
  size_t focal_lengths, coefficients;
  LensKind kind;
};

constexpr ColmapModel kModels[] = {{"SIMPLE_PINHOLE", 1, 0, LensKind::kPinhole},
                                   {"PINHOLE", 2, 0, LensKind::kPinhole},
                                   {"SIMPLE_RADIAL", 1, 1, LensKind::kPlumbBob},
                                   {"RADIAL", 1, 2, LensKind::kPlumbBob},
                                   {"OPENCV", 2, 4, LensKind::kPlumbBob},
                                   {"OPENCV_FISHEYE", 2, 4, LensKind::kKannalaBrandt},
                                   {"FULL_OPENCV", 2, 8, LensKind::kRational},
                                   {"FOV", 2, 1, LensKind::kFov},
                                   {"SIMPLE_RADIAL_FISHEYE", 1, 1, LensKind::kKannalaBrandt},
                                   {"RADIAL_FISHEYE", 1, 2, LensKind::kKannalaBrandt},
                                   {"THIN_PRISM_FISHEYE", 2, 8, LensKind::kKannalaBrandt},
                                   {"RAD_TAN_THIN_PRISM_FISHEYE", 2, 12, LensKind::kKannalaBrandt}};
constexpr int kModelCount = int(std::size(kModels)), kThinPrism = 10, kRadTanThinPrism = 11;

size_t params_of(const ColmapModel& model) { return model.focal_lengths + 2 + model.coefficients; }

const ColmapModel* model_of_camera(const ColmapCamera& camera) {
  if (camera.model >= 0 && camera.model < kModelCount) return &kModels[camera.model];
  for (const ColmapModel& model : kModels)
    if (camera.model_name == model.name) return &model;
  return nullptr;
}

// k1 k2 p1 p2 k3 k4 sx1 sy1: a fisheye with tangential terms, which edgevo reads where they are 0.
std::vector<double> without_thin_prism(const std::vector<double>& k, const std::string& where) {
  if (k[2] != 0 || k[3] != 0 || k[6] != 0 || k[7] != 0)
    throw InputError(where, "THIN_PRISM_FISHEYE has tangential terms, which is not supported",
                     "reconstruct with OPENCV_FISHEYE");
  return {k[0], k[1], k[4], k[5]};
}

}  // namespace

std::optional<size_t> colmap_params(int model) {
  if (model < 0 || model >= kModelCount) return std::nullopt;
  return params_of(kModels[model]);
}

std::vector<std::string> colmap_model_names() {
  std::vector<std::string> names;
  for (const ColmapModel& model : kModels) names.emplace_back(model.name);
  return names;
}

CameraText colmap_camera(const ColmapCamera& camera, const std::string& where) {
  const ColmapModel* model = model_of_camera(camera);
  if (!model || model == &kModels[kRadTanThinPrism])
    throw InputError(where,
                     "COLMAP's model " +
                         (model                       ? model->name
                          : camera.model_name.empty() ? std::to_string(camera.model)
                                                      : quote(camera.model_name)) +
                         " is not supported",
                     "reconstruct with OPENCV, FULL_OPENCV or OPENCV_FISHEYE");
  const auto& p = camera.params;
  if (p.size() != params_of(*model))
    throw InputError(where, std::string(model->name) + " has " + std::to_string(p.size()) + " parameters",
                     "restore the file; there are " + std::to_string(params_of(*model)));
  const size_t f = model->focal_lengths;
  StatedLens lens{model->kind, {p[0], p[f - 1], p[f] - 0.5, p[f + 1] - 0.5}, {}};
  lens.coefficients.assign(p.begin() + long(f) + 2, p.end());
  if (model == &kModels[kThinPrism]) lens.coefficients = without_thin_prism(lens.coefficients, where);
  // The shorter models are the longer ones with zeros.
  if (model->kind == LensKind::kPlumbBob || model->kind == LensKind::kKannalaBrandt)
    lens.coefficients.resize(4, 0.0);
  return camera_of_lens(std::move(lens), image_side(camera.width, where), image_side(camera.height, where),
                        where);
}

}  // namespace edgevo
