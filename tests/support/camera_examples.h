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

inline std::vector<CameraExample> camera_examples() {
  const Pinhole webcam{517.3, 516.5, 318.6, 255.3, 640, 480}, wide{150, 149, 161.2, 118.7, 320, 240};
  return {
      {"Pinhole", Camera(webcam)},
      {"PinholeOfAWideView", Camera(wide)},
      {"PlumbBobOfFreiburg1", Camera(webcam, {0.262383, -0.953104, -0.005358, 0.002628, 1.163314})},
      {"PlumbBobThatFoldsOver", Camera(wide, {-0.25, 0, 0, 0, 0})},
      {"PlumbBobThatFoldsOverAskew", Camera(wide, {-0.3, 0.05, 0.002, -0.001, 0})},
      {"PlumbBobThatFoldsAndUnfolds", Camera(webcam, {-1.2, 0.4, 0, 0, 0})},
  };
}

inline std::string name_of(const ::testing::TestParamInfo<CameraExample>& info) { return info.param.name; }

}  // namespace edgevo::test
