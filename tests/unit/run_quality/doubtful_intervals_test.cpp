// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/doubtful_intervals.h"

#include <gmock/gmock.h>

#include "edgevo/run_quality/run_statistics.h"

namespace edgevo {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Run run_of(int frames) {
  Run run;
  for (int i = 0; i < frames; ++i) {
    FrameRecord frame;
    frame.index = 100 + i;
    frame.state = TrackingState::kTracking;
    frame.p_right = 0.99;
    frame.T_world_cam = SE3();
    run.frames.push_back(frame);
  }
  return run;
}

void doubt(Run* run, int from, int to, const std::string& note) {
  for (int i = from; i <= to; ++i) run->frames[size_t(i)].p_right = 0.01, run->frames[size_t(i)].note = note;
}

std::vector<std::string> texts(const Run& run) {
  std::vector<std::string> texts;
  for (const DoubtfulInterval& s : doubtful_intervals(run)) texts.push_back(to_string(s));
  return texts;
}

TEST(DoubtfulIntervals, ARightRunHasNone) {
  EXPECT_THAT(doubtful_intervals(run_of(50)), IsEmpty());
  EXPECT_EQ(commonest_doubt(run_of(50)), "");
}

TEST(DoubtfulIntervals, FramesOfUnknownTrustAreNotDoubted) {
  edgevo::Run run = run_of(20);
  for (FrameRecord& f : run.frames) f.p_right = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(doubtful_intervals(run), IsEmpty());
}

TEST(DoubtfulIntervals, GiveTheirFramesAndTheCommonestReasonWhateverItsNumbers) {
  edgevo::Run run = run_of(100);
  doubt(&run, 10, 11, "blurred images");
  doubt(&run, 12, 12, "scale fell by 0.30 within 10 frames");
  doubt(&run, 13, 14, "scale fell by 0.40 within 10 frames");
  doubt(&run, 60, 60, "few corners (3)");
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 114: scale fell by 0.30 within 10 frames",
                                      "frame 160: few corners (3)"));
  EXPECT_EQ(commonest_doubt(run), "scale fell by 0.30 within 10 frames");
}

TEST(DoubtfulIntervals, TheMostDoubtfulFrameOfEachOfTheLongestIsFound) {
  edgevo::Run run = run_of(100);
  doubt(&run, 10, 14, "scale fell");
  run.frames[13].p_right = 0.001;
  doubt(&run, 40, 40, "few corners (3)");
  doubt(&run, 60, 62, "blurred images");
  for (int i : {61, 62}) run.frames[size_t(i)].p_right = 0.2;
  EXPECT_THAT(most_doubtful_frames(run, 2), ElementsAre(13u, 60u));
  EXPECT_THAT(most_doubtful_frames(run, 9), ElementsAre(13u, 40u, 60u));
  EXPECT_THAT(most_doubtful_frames(run_of(5), 3), IsEmpty());
}

TEST(DoubtfulIntervals, WhyThereIsNoMapIsAReasonToo) {
  edgevo::Run run = run_of(10);
  for (FrameRecord& f : run.frames) f.T_world_cam.reset(), f.note = "only 12 corners moved";
  EXPECT_EQ(commonest_doubt(run), "only 12 corners moved");
}

TEST(DoubtfulIntervals, IntervalsTenFramesApartAreOne) {
  edgevo::Run run = run_of(100);
  doubt(&run, 10, 10, "a");
  doubt(&run, 21, 21, "a");
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 121: a"));
  EXPECT_EQ(doubtful_intervals(run)[0].frames, 2);
  doubt(&run, 33, 33, "a");
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 121: a", "frame 133: a"));
}

TEST(DoubtfulIntervals, SayWhereNothingLinksTheUnitOfLengthToThatBefore) {
  edgevo::Run run = run_of(100);
  doubt(&run, 10, 12, "a");
  run.frames[23].evidence.unit = UnitComparison{1.01, 0.03};
  doubt(&run, 40, 42, "b");
  run.frames[53].evidence.unit = UnitComparison{};
  doubt(&run, 80, 80, "c");
  EXPECT_THAT(texts(run),
              ElementsAre("frames 110 to 112: a",
                          "frames 140 to 142: b; nothing links the unit of length after it to that before",
                          "frame 180: c"));
}

TEST(DoubtfulIntervals, ANewMapThatNothingLinksIsOneEvenIfEachFrameHasGotAPose) {
  edgevo::Run run = run_of(120);
  doubt(&run, 10, 12, "a");
  run.frames[23].evidence.unit = UnitComparison{1.01, 0.03};
  run.frames[100].evidence.unit = UnitComparison{};
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 112: a",
                                      "frame 200: nothing links the unit of length after it to that before"));
}

TEST(DoubtfulIntervals, ANewMapThatTheGroundLinksIsOneToo) {
  edgevo::Run run = run_of(120);
  run.frames[100].evidence.unit = UnitComparison{0.9, 0.02, true};
  EXPECT_THAT(texts(run),
              ElementsAre("frame 200: the height over the ground links the unit of length after it to "
                          "that before (times 0.9 +- 2.0 %)"));
}

TEST(DoubtfulIntervals, ADoubtSoonAfterANewMapIsAnotherOne) {
  edgevo::Run run = run_of(120);
  doubt(&run, 10, 12, "a");
  run.frames[15].evidence.unit = UnitComparison{};
  doubt(&run, 17, 19, "b");
  run.frames[30].evidence.unit = UnitComparison{};
  const std::string unlinked = "; nothing links the unit of length after it to that before";
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 112: a" + unlinked, "frames 117 to 119: b" + unlinked))
      << "both begin another unit";
}

TEST(DoubtfulIntervals, AComparisonLongAfterwardsSaysNothingOfIt) {
  edgevo::Run run = run_of(120);
  doubt(&run, 10, 12, "a");
  run.frames[15].evidence.unit = UnitComparison{};
  run.frames[100].evidence.unit = UnitComparison{1.01, 0.03};
  EXPECT_THAT(texts(run),
              ElementsAre("frames 110 to 112: a; nothing links the unit of length after it to that before"));
}

TEST(DoubtfulIntervals, LostFramesAreAmongThem) {
  edgevo::Run run = run_of(30);
  run.frames[5].state = TrackingState::kLost;
  run.frames[5].p_right = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(texts(run), ElementsAre("frame 105"));
}

TEST(DoubtfulIntervals, TheLongestAreGivenInOrderOfTime) {
  const std::vector<DoubtfulInterval> all{{0, 1, 2, "", {}}, {20, 29, 10, "", {}}, {50, 54, 5, "", {}}};
  const std::vector<DoubtfulInterval> most = longest(all, 2);
  ASSERT_EQ(most.size(), 2u);
  EXPECT_EQ(most[0].first_frame, 20);
  EXPECT_EQ(most[1].first_frame, 50);
}

TEST(RunCounts, ARunIsLargelyDoubtfulAboveAQuarter) {
  edgevo::Run run = run_of(100);
  doubt(&run, 0, 24, "a");
  EXPECT_EQ(count(run).doubtful, 25);
  EXPECT_FALSE(count(run).is_largely_doubtful());
  doubt(&run, 25, 25, "a");
  EXPECT_TRUE(count(run).is_largely_doubtful());
  EXPECT_FALSE(count(edgevo::Run()).is_largely_doubtful());
}

}  // namespace
}  // namespace edgevo
