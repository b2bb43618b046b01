// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Cameras of all models. Tests with TEST_P over camera_examples() apply to each: a new model needs one line.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"

namespace edgevo::test {

struct CameraExample {
  std::string name;
  Camera camera;
};

inline void PrintTo(const CameraExample& e, std::ostream* out) { *out << e.name; }

/// A camera of 640 x 480 pixels whose model has the focal length `f` on the axis.
template <class Model>
Camera wide_camera(Model model, double f) {
  Camera camera;
  camera.model = model;
  camera.set_pinhole({f, 0.99 * f, 321.3, 238.6, 640, 480});
  return camera;
}

inline std::vector<CameraExample> camera_examples() {
  const Pinhole webcam{517.3, 516.5, 318.6, 255.3, 640, 480}, wide{150, 149, 161.2, 118.7, 320, 240};
  return {
      {"Pinhole", Camera(webcam)},
      {"PinholeOfAWideView", Camera(wide)},
      {"PlumbBobOfFreiburg1", Camera(webcam, {0.262383, -0.953104, -0.005358, 0.002628, 1.163314})},
      {"PlumbBobThatFoldsOver", Camera(wide, {-0.25, 0, 0, 0, 0})},
      {"PlumbBobThatFoldsOverAskew", Camera(wide, {-0.3, 0.05, 0.002, -0.001, 0})},
      {"PlumbBobThatFoldsAndUnfolds", Camera(webcam, {-1.2, 0.4, 0, 0, 0})},
      {"RationalOfAWideView",
       wide_camera(RationalModel{{}, {{3.1, 1.4, 2e-4, -1e-4, 0.05}, 3.4, 2.2, 0.26, 0, 0, 0, 0}}, 250)},
      {"RationalWithThinPrism",
       wide_camera(RationalModel{{}, {{-0.2, 0.1, 1e-3, 2e-3, 0}, 0.02, 0, 0, 1e-3, -2e-3, 5e-4, 1e-4}},
                   400)},
      {"RationalWithAPole", wide_camera(RationalModel{{}, {{0.1, 0, 0, 0, 0}, -0.3, 0, 0, 0, 0, 0, 0}}, 400)},
      {"KannalaBrandtOf190Degrees",
       wide_camera(KannalaBrandtModel{{}, 3.4e-3, 7.6e-4, -9.9e-4, 2.1e-4}, 190)},
      {"KannalaBrandtThatFoldsOver", wide_camera(KannalaBrandtModel{{}, -0.13, 0.02, -0.01, 0.001}, 250)},
      {"Fov", wide_camera(FovModel{{}, 0.93}, 280)},
      {"Unified", wide_camera(ExtendedUnifiedModel{{}, 0.64, 1}, 240)},
      {"ExtendedUnified", wide_camera(ExtendedUnifiedModel{{}, 0.57, 1.18}, 220)},
      {"ExtendedUnifiedOfLessThanHalf", wide_camera(ExtendedUnifiedModel{{}, 0.4, 0.9}, 300)},
      {"DoubleSphere", wide_camera(DoubleSphereModel{{}, -0.18, 0.59}, 190)},
      {"DoubleSphereOfLessThanHalf", wide_camera(DoubleSphereModel{{}, 0.3, 0.4}, 190)},
      {"Omni", wide_camera(OmniModel{{}, 1.6, {-0.1, 0.2, 1e-3, -5e-4, 0}}, 230)},
      {"OmniOfLessThanOne", wide_camera(OmniModel{{}, 0.8, {}}, 230)},
  };
}

inline std::string name_of(const ::testing::TestParamInfo<CameraExample>& info) { return info.param.name; }

}  // namespace edgevo::test
