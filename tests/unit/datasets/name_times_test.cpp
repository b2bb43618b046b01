// SPDX-License-Identifier: BSD-3-Clause
#include "name_times.h"

#include <gmock/gmock.h>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

// Step between the first two of these names, in seconds; 0: they hold no times.
double step_of(const std::vector<std::string>& names, const std::string& unit = "") {
  const auto found = times_of_names(names, unit);
  return found ? seconds_between(found->times.at(0), found->times.at(1)) : 0;
}

TEST(NameTimes, UnitsAreRecognisedByTheirDate) {
  EXPECT_EQ(step_of({"1400075892", "1400075893"}), 1);
  EXPECT_EQ(step_of({"1400075892456", "1400075892489"}), 0.033);
  EXPECT_EQ(step_of({"1400075892456789", "1400075892556789"}), 0.1);
  EXPECT_EQ(step_of({"1400075892456789000", "1400075892556789000"}), 0.1);
  const auto micro = times_of_names({"1400075892456789", "1400075892556789"}, "");
  EXPECT_EQ(micro->times[0].ticks, 14000758924567890);
  EXPECT_EQ(to_string(micro->decision),
            "times: from the names of the images, in microseconds (by their size, as a time since 1970)");
  EXPECT_EQ(micro->decision.doubt, "");
}

TEST(NameTimes, CountersAreNoTimes) {
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{{"000017", "000018"},
                                             {"0000000017", "0000000018"},
                                             {"0000000000017", "0000000000018"},
                                             {"frame_1.2", "frame_1.3"},
                                             {"a_1", "b_2"},
                                             {"left", "right"}})
    EXPECT_FALSE(times_of_names(names, "")) << names[0];
}

TEST(NameTimes, TheBeginningOfTheNamesMayBeTheSame) {
  EXPECT_NEAR(step_of({"rgb_1305031102.175304", "rgb_1305031102.211214"}), 0.03591, 1e-9);
  EXPECT_NEAR(step_of({"cam0_1403636579763555584", "cam0_1403636579813555456"}), 0.05, 1e-6);
  EXPECT_EQ(step_of({"12.25", "12.5"}), 0.25);
}

TEST(NameTimes, AClockIsRead) {
  EXPECT_NEAR(step_of({"frame_00_01_27.000", "frame_00_01_27.033"}), 0.033, 1e-9);
  EXPECT_EQ(step_of({"00-59-59.5", "01-00-00.5"}), 1);
  const auto found = times_of_names({"frame_00_01_27.000"}, "");
  EXPECT_EQ(found->times[0], Timestamp::from_seconds(87));
  EXPECT_EQ(
      to_string(found->decision),
      "times: hours, minutes and seconds in the names of the images (frame_00_01_27.000 is 87.0000000 s)");
}

TEST(NameTimes, NanosecondsOfAnotherClockThatNoVideoHasAreADoubt) {
  EXPECT_EQ(times_of_names({"100000000000000000", "100000000100000000"}, "")->decision.doubt, "");
  EXPECT_THAT(times_of_names({"20239905123456789", "20239905123456822"}, "")->decision.doubt,
              HasSubstr("give --time-unit, or --fps if the numbers count"));
}

TEST(NameTimes, DatesWithClocksAreRead) {
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{{"20260517_235959_900", "20260518_000000_000"},
                                             {"IMG_20260517_235959900", "IMG_20260518_000000000"},
                                             {"2026-05-17_23-59-59.900", "2026-05-18_00-00-00.000"},
                                             {"2026-05-17T23:59:59.9Z", "2026-05-18T00:00:00.0Z"},
                                             {"2026-05-17T23:59:59.9+02:00", "2026-05-18T00:00:00.0+02:00"},
                                             {"20260517235959900", "20260518000000000"}})
    EXPECT_NEAR(step_of(names), 0.1, 1e-9) << names[0];
  EXPECT_EQ(times_of_names({"2026-05-17T23:59:59.9Z"}, "")->times[0], Timestamp{17790623999000000});
  EXPECT_EQ(step_of({"235957_100", "235957_233", "235958_001"}), 0.133);
}

TEST(NameTimes, CountersThatLookLikeClocksAreNone) {
  EXPECT_EQ(step_of({"000017_001", "000018_001"}), 0);
  EXPECT_EQ(step_of({"000017_001", "000017_002"}), 0);
  EXPECT_EQ(step_of({"20260517_000017", "20260517_000018"}), 0);
}

TEST(NameTimes, TheUserMaySetTheUnit) {
  EXPECT_EQ(step_of({"0001", "0034"}, "ms"), 0.033);
  EXPECT_THROW(times_of_names({"0001"}, "h"), InputError);
}

}  // namespace
}  // namespace edgevo
