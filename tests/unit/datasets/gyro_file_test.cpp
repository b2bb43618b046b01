// SPDX-License-Identifier: BSD-3-Clause
// Files of gyros: units, order of the columns, and what is wrong with one.
#include "edgevo/datasets/gyro_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "edgevo/core/angle.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/random.h"
#include "support/temp_folder.h"

namespace edgevo::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class GyroFileTest : public ::testing::Test {
 protected:
  GyroFile read(const std::string& text) {
    write_file(path(), text);
    return read_gyro_file(path());
  }
  std::string error_of(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }
  std::string path() const { return folder_.path() + "/imu.txt"; }
  TempFolder folder_;
};

TEST_F(GyroFileTest, ReadsEuroc) {
  const GyroFile file = read(
      "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m "
      "s^-2],a_y,a_z\n"
      "1403636579758555392,-0.099,0.14,0.029,8.1,-0.37,-2.4\n1403636579763555584,-0.1,0.15,0.03,8.1,-0.4,-2."
      "4\n");
  ASSERT_EQ(file.samples.size(), 2u);
  EXPECT_EQ(file.samples[0].time, Timestamp::from_nanoseconds(1403636579758555392));
  EXPECT_EQ(file.samples[1].rate, Eigen::Vector3d(-0.1, 0.15, 0.03));
}

TEST_F(GyroFileTest, ReadsBlanksAndRatesAlone) {
  const GyroFile file = read("0.005 1 2 3\n0.010 4 5 6\n");
  EXPECT_EQ(file.samples[1].time, Timestamp::from_seconds(0.01));
  EXPECT_EQ(file.samples[1].rate, Eigen::Vector3d(4, 5, 6));
}

TEST_F(GyroFileTest, BelievesAHeaderThatNamesDegreesOrAccelerationsFirst) {
  EXPECT_NEAR(read("# t, gyro_x [deg/s], y, z\n0.005,180,0,0\n0.01,0,0,0\n").samples[0].rate.x(), rad(180),
              1e-12);
  EXPECT_NEAR(read("time,gyro_x(deg/s),gyro_y,gyro_z\n0.005,180,0,0\n0.01,0,0,0\n").samples[0].rate.x(),
              rad(180), 1e-12);
  const GyroFile file = read("# t a.x a.y a.z w.x w.y w.z\n0.005 0 0 1 4 5 6\n0.01 0 0 1 4 5 6\n");
  EXPECT_EQ(file.samples[0].rate, Eigen::Vector3d(4, 5, 6));
}

TEST_F(GyroFileTest, ATripleAsLongAsGravityIsTheAcceleration) {
  const GyroFile file = read("0.005 0 9.8 0.1 0.1 0 0\n0.01 0 9.8 0.1 0.2 0 0\n");
  EXPECT_EQ(file.samples[1].rate, Eigen::Vector3d(0.2, 0, 0));
  EXPECT_THAT(file.decided, HasSubstr("gravity"));
}

TEST_F(GyroFileTest, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(error_of("0.005 1 2\n"), HasSubstr("imu.txt, line 1: has 3 fields"));
  EXPECT_THAT(error_of("0.005 1 2 3\n0.01 1 x 3\n"), HasSubstr("line 2: 'x' is not a number"));
  EXPECT_THAT(error_of("0.01 1 2 3\n0.02 1 2 3\n0.03 1 2 3\n0.025 1 2 3\n"),
              HasSubstr("line 4: its time is before"));
  EXPECT_THAT(error_of("0.005 1 2 3\n0.01 1 2 1403636579758\n"), HasSubstr("no gyro measures"));
  EXPECT_THAT(error_of("0.15 1 2 3\n0.3 1 2 3\n"), HasSubstr("not those of a gyro"));
  EXPECT_THAT(error_of("# nothing\n"), HasSubstr("fewer than two"));
}

TEST_F(GyroFileTest, DescribesRateGapsAndRest) {
  std::string text;
  for (int i = 0; i < 600; ++i)
    if (i < 300 || i > 320)
      text += std::to_string(0.005 * i) + (i < 300 ? " 0.01 -0.02 0\n" : i % 2 ? " 1 0 0\n" : " -1 0 0\n");
  const std::vector<GyroSample> samples = read(text).samples;
  size_t next = 0;
  const auto lines = describe_gyro([&]() -> std::optional<GyroSample> {
    return next < samples.size() ? std::make_optional(samples[next++]) : std::nullopt;
  });
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines[0].second,
              AllOf(HasSubstr("200.0 Hz, 1 gaps, the longest of 0.11"), HasSubstr("stuck for 1.5 s")));
  EXPECT_THAT(lines[1].second, HasSubstr("(0.573, -1.146, 0.000)"));
}

TEST_F(GyroFileTest, CountsWhatIsMissingAndMeasuresTheNoise) {
  constexpr double kStep = 0.005, kNoise = rad(0.01);  // rad/s over the root of a hertz
  Random random(1);
  std::vector<GyroSample> samples;
  for (int i = 0; i < 2000; ++i) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    if (i > 100 && i < 1999 && random.uniform() < 0.1) continue;
    samples.push_back(
        {Timestamp::from_seconds(kStep * i), kNoise / std::sqrt(kStep) * Eigen::Vector3d(x, y, z)});
  }
  size_t next = 0;
  const auto lines = describe_gyro([&]() -> std::optional<GyroSample> {
    return next < samples.size() ? std::make_optional(samples[next++]) : std::nullopt;
  });
  const std::string missing = std::to_string(2000 - samples.size()) + " samples missing";
  EXPECT_THAT(lines[0].second, AllOf(HasSubstr(missing), HasSubstr("noise 0.0100 degrees/s/sqrt(Hz)")));
}

}  // namespace
}  // namespace edgevo::test
