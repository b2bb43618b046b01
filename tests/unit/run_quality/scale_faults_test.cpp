// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/scale_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/run_quality/closing_lines.h"

namespace edgevo {
namespace {

ScaleFault wheels() { return {"odometry", 310, 372, std::log(1.2), 0.012, 0}; }

TEST(ScaleFaults, InWords) {
  EXPECT_EQ(to_string(wheels()),
            "odometry: lengths contradict the rest by +20 +- 1 % in frames 310 to 372, where it does not "
            "count");
  EXPECT_EQ(to_string(ScaleFault{"gps", 60, 108, 0, 0, 15.04}),
            "gps: positions displaced by 15.0 m in frames 60 to 108");
  EXPECT_EQ(to_string(ScaleFault{"gps", 60, 60, 0, 0, 15.04}),
            "gps: positions displaced by 15.0 m at frame 60");
  EXPECT_EQ(to_string(ScaleFault{"gps", 0, 299, 0, 0, 0}),
            "gps: gives no scale, since it does not fit the path of the camera");
}

TEST(ScaleFaults, AClockThatIsOff) {
  edgevo::Run run;
  run.scale.clock_offsets["gps"] = {-0.5, 0.012};
  EXPECT_THAT(scale_faults_in_words(run),
              ::testing::ElementsAre(
                  "gps: its stamps are 0.50 +- 0.01 s earlier than the camera's; its times were corrected"));
}

TEST(ScaleFaults, AreWarningsAmongTheClosingLines) {
  edgevo::Run run;
  run.scale.faults.push_back(wheels());
  const std::vector<ClosingLine> lines = closing_lines(run, "out", false);
  const auto fault = std::find_if(lines.begin(), lines.end(), [](const ClosingLine& line) {
    return line.text == "scale: " + to_string(wheels());
  });
  ASSERT_NE(fault, lines.end());
  EXPECT_TRUE(fault->is_warning);
}

}  // namespace
}  // namespace edgevo
