// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/closing_lines.h"

#include <gmock/gmock.h>

namespace edgevo {
namespace {

using ::testing::HasSubstr;

Run run_with_poses(int frames, int with_pose) {
  Run run;
  for (int i = 0; i < frames; ++i) {
    FrameRecord frame;
    frame.index = i;
    frame.state = i < with_pose ? TrackingState::kTracking : TrackingState::kLost;
    frame.p_right = 0.99;
    if (i < with_pose) frame.T_world_cam = SE3();
    if (i >= with_pose) frame.note = "few edges";
    run.frames.push_back(frame);
  }
  return run;
}

// The second one begins with frame 6.
edgevo::Run run_in_two_segments(const SegmentRecord& second) {
  edgevo::Run run = run_with_poses(10, 10);
  for (size_t i = 0; i < 10; ++i) run.frames[i].segment = i < 6 ? 0 : 1;
  run.segments = {{"origin", 0}, second};
  return run;
}

TEST(ClosingLines, BeginWithTheCountsAndEndWithTheFolder) {
  const std::vector<ClosingLine> lines = closing_lines(run_with_poses(10, 10), "out");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines.front().text, HasSubstr("10 frames, 10 with a pose, 0 doubtful"));
  EXPECT_EQ(lines.back().text, "results in out (listed in summary.yaml)");
}

TEST(ClosingLines, WhatIsNotToBeTrustedIsAWarning) {
  const std::vector<ClosingLine> lines = closing_lines(run_with_poses(10, 6), "out");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_TRUE(lines[1].is_warning);
  EXPECT_EQ(lines[1].text, "NOT TO BE TRUSTED: frames 6 to 9: few edges");
}

TEST(ClosingLines, AGuessedPlaceIsNotToBeTrustedUpToTheEnd) {
  edgevo::Run run = run_in_two_segments({"equal speed", 0.5});
  const std::vector<ClosingLine> lines = closing_lines(run, "out");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_TRUE(lines[1].is_warning);
  EXPECT_EQ(
      lines[1].text,
      "NOT TO BE TRUSTED: frames 6 to 9: place and direction are guessed (by equal speed): nothing links "
      "them to what was before");
  run.constraints.push_back({"ground", 3, 8, 1, 0.1, true});
  EXPECT_EQ(closing_lines(run, "out").size(), 3u) << "which gives lengths only";
  run.constraints.push_back({"features", 3, 8, 1, 0.1, true});
  EXPECT_EQ(closing_lines(run, "out").size(), 2u);
}

TEST(FailureStatement, CountsPlacesThatAreAGuess) {
  edgevo::Run run = run_in_two_segments({"equal speed", 0.5});
  EXPECT_EQ(failure_statement(run, "it", ""),
            "4 of 10 poses of it are doubtful or in a place that is a guess; mostly: nothing links them to "
            "what was "
            "before");
  run.constraints.push_back({"features", 3, 8, 1, 0.1, true});
  EXPECT_FALSE(failure_statement(run, "it", ""));
  EXPECT_FALSE(failure_statement(run_in_two_segments({"views of both maps", 0.03}), "it", ""));
}

TEST(FailureStatement, NamesTheGuessWhereItIsMostOfWhatIsWrong) {
  edgevo::Run run = run_in_two_segments({"equal speed", 0.5});
  run.frames[2].state = TrackingState::kDegraded, run.frames[2].note = "few edges";
  EXPECT_EQ(failure_statement(run, "it", ""),
            "5 of 10 poses of it are doubtful or in a place that is a guess; mostly: nothing links them to "
            "what was "
            "before");
}

TEST(FailureStatement, NamesTheEndOfTheImagesWhereNothingElseWasNoted) {
  edgevo::Run run = run_with_poses(1, 0);
  run.frames[0].reasons = {{ReasonKind::kFirstView}};
  run.frames[0].note = "first view taken";
  EXPECT_EQ(failure_statement(run, "it", ""),
            "tracking failed for most of it; mostly: the images ended before there was a map");
}

TEST(ClosingLines, SayWhyFramesHaveNoPose) {
  edgevo::Run run = run_with_poses(10, 8);
  for (size_t i = 8; i < 10; ++i) run.frames[i].state = TrackingState::kBootstrapping;
  EXPECT_EQ(closing_lines(run, "out")[1].text, "2 frames have no pose; mostly: few edges");
  EXPECT_FALSE(closing_lines(run, "out")[1].is_warning);
  run.frames[7].T_world_cam.reset();
  EXPECT_TRUE(closing_lines(run, "out")[1].is_warning) << "a quarter of them";
}

TEST(ClosingLines, WhatAPlaceRestsOnAfterALossIsSaid) {
  edgevo::Run run = run_in_two_segments({"views of both maps", 0.028});
  const std::vector<ClosingLine> lines = closing_lines(run, "out");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_FALSE(lines[1].is_warning);
  EXPECT_EQ(lines[1].text, "frames 6 on: unit of length and place by views of both maps, to 3 %");
}

TEST(ClosingLines, AStepOnTheWayToAMapIsNoReason) {
  edgevo::Run run = run_with_poses(10, 0);
  for (size_t i = 0; i < 10; ++i) {
    run.frames[i].reasons = {i < 7 ? Reason{ReasonKind::kFirstView}
                                   : Reason{ReasonKind::kFewCorners, 20, 80}};
    run.frames[i].note = to_string(run.frames[i].reasons);
  }
  EXPECT_THAT(failure_statement(run, "it", "").value_or(""),
              HasSubstr("mostly: only 20 corners in the image"));
}

TEST(ClosingLines, LinksThatWereTakenForMistakesAreSaid) {
  edgevo::Run run = run_with_poses(10, 10);
  run.constraints = {{"features", 1, 5, 1, 0.02, true}, {"features", 1, 7, 0.7, 0.02, false}};
  const std::vector<ClosingLine> lines = closing_lines(run, "out");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[1].text, HasSubstr("1 of 2 links"));
}

TEST(FailureStatement, GivesTheCommonestReason) {
  EXPECT_FALSE(failure_statement(run_with_poses(10, 9), "seq"));
  EXPECT_EQ(*failure_statement(run_with_poses(10, 2), "seq", "out/earlier_run"),
            "tracking failed for most of seq; mostly: few edges; the earlier run is kept in out/earlier_run");
}

}  // namespace
}  // namespace edgevo
