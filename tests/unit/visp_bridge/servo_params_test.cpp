// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/servo_params.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

std::string written(OdometryParams params) {
  return write_params([&](ParamVisitor& v) { params.visit(v); });
}

TEST(ServoParams, AreThoseOfTheFile) {
  OdometryParams params;
  read_params_file(std::string(EDGEVO_SOURCE_DIR) + "/params/servo.yaml",
                   [&](ParamVisitor& v) { params.visit(v); });
  EXPECT_EQ(written(params), written(servo_odometry_params()));
  EXPECT_NE(written(params), written(OdometryParams()));
}

}  // namespace
}  // namespace edgevo
