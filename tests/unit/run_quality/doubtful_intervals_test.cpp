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

const Reason kA{ReasonKind::kTurn}, kB{ReasonKind::kSteps}, kC{ReasonKind::kMapMoved, 0.06};

void doubt(Run* run, int from, int to, const Reason& reason) {
  for (int i = from; i <= to; ++i) {
    FrameRecord& frame = run->frames[size_t(i)];
    frame.p_right = 0.01, frame.reasons = {reason}, frame.note = to_string(reason);
  }
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
  doubt(&run, 10, 11, {ReasonKind::kTurn});
  doubt(&run, 12, 12, {ReasonKind::kScaleByCorners, 0.7, 10});
  doubt(&run, 13, 14, {ReasonKind::kScaleByCorners, 0.6, 10});
  doubt(&run, 60, 60, {ReasonKind::kResidual, 3});
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 114: scale fell by 0.30 within 10 frames",
                                      "frame 160: edges are 3.0 px off where the map puts them"));
  EXPECT_EQ(commonest_doubt(run), "scale fell by 0.30 within 10 frames");
}

TEST(DoubtfulIntervals, TheMostDoubtfulFrameOfEachOfTheLongestIsFound) {
  edgevo::Run run = run_of(100);
  doubt(&run, 10, 14, kA);
  run.frames[13].p_right = 0.001;
  doubt(&run, 40, 40, {ReasonKind::kResidual, 3});
  doubt(&run, 60, 62, {ReasonKind::kTurn});
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
  doubt(&run, 10, 10, kA);
  doubt(&run, 21, 21, kA);
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 121: a translation that the turn hides"));
  EXPECT_EQ(doubtful_intervals(run)[0].frames, 2);
  doubt(&run, 33, 33, kA);
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 121: a translation that the turn hides",
                                      "frame 133: a translation that the turn hides"));
}

TEST(DoubtfulIntervals, SayWhereNothingLinksTheUnitOfLengthToThatBefore) {
  edgevo::Run run = run_of(100);
  doubt(&run, 10, 12, kA);
  run.frames[23].evidence.unit = RelativeScale{1.01, 0.03};
  doubt(&run, 40, 42, kB);
  run.frames[53].evidence.unit = RelativeScale{};
  doubt(&run, 80, 80, kC);
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 112: a translation that the turn hides",
                                      "frames 140 to 142: steps unlike those before; nothing links the unit "
                                      "of length after it to that before",
                                      "frame 180: the map moved under the camera within 10 frames (by "
                                      "6.0 % of the depth)"));
}

TEST(DoubtfulIntervals, ANewMapThatNothingLinksIsOneEvenIfEachFrameHasGotAPose) {
  edgevo::Run run = run_of(120);
  doubt(&run, 10, 12, kA);
  run.frames[23].evidence.unit = RelativeScale{1.01, 0.03};
  run.frames[100].evidence.unit = RelativeScale{};
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 112: a translation that the turn hides",
                                      "frame 200: nothing links the unit of length after it to that before"));
}

TEST(DoubtfulIntervals, ANewMapThatTheGroundLinksIsOneToo) {
  edgevo::Run run = run_of(120);
  run.frames[100].evidence.unit = RelativeScale{0.9, 0.02, true};
  EXPECT_THAT(texts(run),
              ElementsAre("frame 200: the height over the ground links the unit of length after it to "
                          "that before (times 0.9 +- 2.0 %)"));
}

TEST(DoubtfulIntervals, ADoubtSoonAfterANewMapIsAnotherOne) {
  edgevo::Run run = run_of(120);
  doubt(&run, 10, 12, kA);
  run.frames[15].evidence.unit = RelativeScale{};
  doubt(&run, 17, 19, kB);
  run.frames[30].evidence.unit = RelativeScale{};
  const std::string unlinked = "; nothing links the unit of length after it to that before";
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 112: a translation that the turn hides" + unlinked,
                                      "frames 117 to 119: steps unlike those before" + unlinked))
      << "both begin another unit";
}

TEST(DoubtfulIntervals, AComparisonLongAfterwardsSaysNothingOfIt) {
  edgevo::Run run = run_of(120);
  doubt(&run, 10, 12, kA);
  run.frames[15].evidence.unit = RelativeScale{};
  run.frames[100].evidence.unit = RelativeScale{1.01, 0.03};
  EXPECT_THAT(texts(run), ElementsAre("frames 110 to 112: a translation that the turn hides; nothing links "
                                      "the unit of length after it to that before"));
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
  doubt(&run, 0, 24, kA);
  EXPECT_EQ(count(run).doubtful, 25);
  EXPECT_FALSE(count(run).is_largely_doubtful());
  doubt(&run, 25, 25, kA);
  EXPECT_TRUE(count(run).is_largely_doubtful());
  EXPECT_FALSE(count(edgevo::Run()).is_largely_doubtful());
}

}  // namespace
}  // namespace edgevo
