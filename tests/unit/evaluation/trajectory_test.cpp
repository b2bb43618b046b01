// SPDX-License-Identifier: BSD-3-Clause
// The readers of TUM and KITTI files.
#include "edgevo/evaluation/trajectory.h"

#include <gmock/gmock.h>

#include "support/synthetic_trajectory.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using test::input_error_of;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string error_of(const std::string& text) {
  return input_error_of([&] { parse_trajectory(text, "t.txt"); });
}

TEST(Trajectory, ReadsTumWithCommentsBlanksAndCarriageReturns) {
  const Trajectory t = parse_trajectory(
      "# time and pose\r\n\r\n1305031102.1753  1 2\t3 0 0 0 1\r\n  1305031102.2 4 5 6 0.5 0.5 0.5 0.5",
      "t.txt");
  EXPECT_EQ(t.format, TrajectoryFormat::kTum);
  ASSERT_EQ(t.poses.size(), 2u);
  EXPECT_EQ(t.poses[0].time.ticks, 13050311021753000);
  EXPECT_EQ(t.poses[0].T_world_cam.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(t.poses[1].T_world_cam.rotation().isApprox(Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), 1e-12));
}

TEST(Trajectory, ReadsKittiRows) {
  const Trajectory t = parse_trajectory("1 0 0 1 0 1 0 2 0 0 1 3\n0 -1 0 4 1 0 0 5 0 0 1 6\n", "k.txt");
  EXPECT_EQ(t.format, TrajectoryFormat::kKitti);
  ASSERT_EQ(t.poses.size(), 2u);
  EXPECT_EQ(t.poses[1].time.ticks, Timestamp::kTicksPerSecond);
  EXPECT_EQ(t.poses[1].T_world_cam.translation(), Eigen::Vector3d(4, 5, 6));
  EXPECT_TRUE(
      (t.poses[1].T_world_cam.R() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
}

TEST(Trajectory, ErrorsNameFileAndLine) {
  const std::string good = "0 0 0 0 0 0 0 1\n";
  EXPECT_THAT(error_of(good + "1 2 3\n"), StartsWith("t.txt:2: 3 fields where the lines before have 8"));
  EXPECT_THAT(error_of("# x\n1 2 3\n"), StartsWith("t.txt:2: 3 fields; a TUM line has 8"));
  EXPECT_THAT(error_of(good + "1 0 zero 0 0 0 0 1\n"), StartsWith("t.txt:2: 'zero' is not a number"));
  EXPECT_THAT(error_of(good + "1 0 nan 0 0 0 0 1\n"), StartsWith("t.txt:2: 'nan' is not finite"));
  EXPECT_THAT(error_of(good + "1 0 inf 0 0 0 0 1\n"), StartsWith("t.txt:2: 'inf' is not finite"));
  EXPECT_THAT(error_of(good + "1 0 1e999 0 0 0 0 1\n"), StartsWith("t.txt:2: '1e999' is not a number"));
  EXPECT_THAT(error_of(good + "one 0 0 0 0 0 0 1\n"), StartsWith("t.txt:2: time 'one'"));
  EXPECT_THAT(error_of(good + "1 0 0 0 0 0 0 0\n"), HasSubstr("not a unit quaternion"));
  EXPECT_THAT(error_of(good + "0 1 0 0 0 0 0 1\n"), HasSubstr("time 0.0000000 again"));
  EXPECT_THAT(error_of("1 0 0 0 0 1 0 0 0 0 2 0\n"), StartsWith("t.txt:1: the 3x3 part is not a rotation"));
  EXPECT_THAT(error_of("-1 0 0 0 0 1 0 0 0 0 1 0\n"), HasSubstr("not a rotation"));  // a mirror
  EXPECT_THAT(error_of("# nothing\n"), StartsWith("t.txt: contains no pose"));
  EXPECT_THAT(error_of(""), StartsWith("t.txt: contains no pose"));
}

TEST(Trajectory, AMissingFileOrAFolderIsAnInputError) {
  EXPECT_THAT(input_error_of([] { read_trajectory("/nonexistent/t.txt"); }), HasSubstr("cannot be read"));
  const test::TempFolder folder;
  EXPECT_THAT(input_error_of([&] { read_trajectory(folder / "."); }), HasSubstr("cannot be read"));
  EXPECT_THAT(input_error_of([&] { read_trajectory(folder.write("empty.txt", "")); }),
              HasSubstr("contains no pose"));
}

TEST(Trajectory, KeepsTheLastDigitOfLargeTimes) {
  const Trajectory t =
      parse_trajectory("1600000000.1234567 0 0 0 0 0 0 1\n1600000000.1234568 0 0 0 0 0 0 1\n", "t");
  EXPECT_EQ(t.poses[1].time.ticks - t.poses[0].time.ticks, 1);
}

// Damages a good file at random: the outcome is a valid trajectory or an error message of one line.
TEST(Trajectory, SurvivesDamagedFiles) {
  Random random(7);
  const std::string tum = "# c\n0.1 1 2 3 0 0 0 1\n0.2 1 2 4 0 0 0 1\n0.3 1 2 5 0.5 0.5 0.5 0.5\n";
  const std::string kitti = "1 0 0 1 0 1 0 2 0 0 1 3\n0 -1 0 4 1 0 0 5 0 0 1 6\n";
  constexpr char kAlphabet[] = "0123456789.-+eE \t\r\n#naif,;\x80\xff";  // its closing NUL is drawn too
  int parsed = 0, refused = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string text = trial % 2 ? tum : kitti;
    for (int changes = 1 + random.below(4); changes > 0; --changes) {
      const size_t at = size_t(random.below(int(text.size())));
      const char c = kAlphabet[random.below(int(sizeof kAlphabet))];
      switch (random.below(3)) {
        case 0:
          text[at] = c;
          break;
        case 1:
          text.insert(at, 1, c);
          break;
        case 2:
          text.erase(at, size_t(random.below(10)));
          break;
      }
    }
    try {
      const Trajectory t = parse_trajectory(text, "f");
      ++parsed;
      for (size_t i = 0; i < t.poses.size(); ++i) {
        ASSERT_TRUE(t.poses[i].T_world_cam.is_finite()) << text;
        if (i > 0) {
          ASSERT_LT(t.poses[i - 1].time, t.poses[i].time) << text;
        }
      }
    } catch (const InputError& e) {
      ++refused;
      ASSERT_EQ(std::string(e.what()).find_first_of("\r\n"), std::string::npos) << text;
      ASSERT_THAT(e.what(), StartsWith("f:"));
    }
  }
  EXPECT_GT(parsed, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace edgevo
