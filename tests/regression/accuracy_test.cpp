// SPDX-License-Identifier: BSD-3-Clause
// The whole odometry against ground truth. A bound is at most twice the largest figure measured (README.md),
// so that another compiler or processor, which acts like another seed, passes and a fault does not. On one
// kind of machine a repeated run gives the same bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "edgevo/datasets/open_source.h"
#include "edgevo/datasets/subsample.h"
#include "edgevo/simulation/relit_source.h"
#include "edgevo/simulation/rendered_source.h"
#include "edgevo/simulation/simulated_gyro.h"
#include "rendered_sequences.h"
#include "run_figures.h"

namespace edgevo::test {
namespace {

namespace fs = std::filesystem;

struct Bounds {
  /// ATE after Sim(3) alignment, percent of the path length.
  double ate_percent;
  /// Largest |ln| of the local scale.
  double scale_drift;
};

void expect_within(const RunAccuracy& figures, const Bounds& bounds) {
  EXPECT_LT(figures.ate_percent, bounds.ate_percent);
  EXPECT_LT(figures.scale_drift, bounds.scale_drift);
  EXPECT_EQ(figures.completion, 1);  // for every seed so far
  EXPECT_EQ(figures.first_posed, 0);
  for (const FrameRecord& frame : figures.run.frames) {
    EXPECT_EQ(frame.segment, 0) << "frame " << frame.index;
    if (frame.T_world_cam) {
      ASSERT_TRUE(frame.T_world_cam->is_finite()) << "frame " << frame.index;
    }
  }
}

void expect_sequence_within(const RenderedSequence& sequence, const Bounds& bounds,
                            const std::optional<Pinhole>& working_pinhole = {}) {
  for_each_seed(
      sequence.clip, sequence.truth, [&](const RunAccuracy& figures) { expect_within(figures, bounds); },
      working_pinhole);
}

// Seven eighths of the size at four fifths of the focal length: a view wider by a tenth, whose outermost
// pixels have no source.
Pinhole wider_and_smaller(const Pinhole& p) {
  constexpr double kSize = 0.875, kFocal = 0.8;
  return {kFocal * p.fx,
          kFocal * p.fy,
          kSize * (p.cx + 0.5) - 0.5,
          kSize * (p.cy + 0.5) - 0.5,
          int(std::lround(kSize * p.width)),
          int(std::lround(kSize * p.height))};
}

// The covariance holds on each scene (alignment/pose_covariance.h, confidence/tracking_check.h).
// The desk is the worst, whose first map is poor: too wide, 0.63, 37 % of the frames inside and nearly all
// others below; the others 0.66 to 0.77, 86 to 89 % (lab 2026-11-27_what_edges_share).
void expect_consistent(const Consistency& c) {
  EXPECT_GE(c.frames, 10);  // on the street most frames become keyframes
  EXPECT_GT(c.mean_ratio, 0.4);
  EXPECT_LT(c.mean_ratio, 2.5);
  EXPECT_GT(c.inside, 0.3);
}

void expect_accurate_and_consistent(const RenderedSequence& sequence, const Bounds& bounds) {
  for_each_seed(sequence.clip, sequence.truth, [&](const RunAccuracy& figures) {
    expect_within(figures, bounds);
    expect_consistent(figures.consistency);
  });
}

TEST(RenderedAccuracy, StreetDrive) {
  // Seeds 1 and 2: 0.0061 and 0.0093 %, 0.0012.
  expect_accurate_and_consistent(part_of(street_sequence(), 0, 80), {0.018, 0.0024});
}

// Driving backwards: nothing leaves the view, and what enters it is near and new
// (lab 2026-11-23_backward_motion).
TEST(RenderedAccuracy, StreetDriveBackwards) {
  // Seeds 1 to 5: up to 0.0112 %, 0.00175.
  expect_sequence_within(backward(part_of(street_sequence(), 0, 80)), {0.0225, 0.0035});
}

TEST(RenderedAccuracy, HandHeldOverADesk) {
  expect_accurate_and_consistent(desk_sequence(), {0.12, 0.02});  // seeds 1 to 5: up to 0.060 %, 0.0099
}

// About as accurate as in the camera's own pinhole. Seed 1: 0.084 %, 0.0105.
TEST(RenderedAccuracy, ADeskInAnotherPinhole) {
  expect_sequence_within(desk_sequence(), {0.12, 0.02},
                         wider_and_smaller(desk_sequence().clip->camera.pinhole()));
}

TEST(RenderedAccuracy, BoatAlongAShore) {
  expect_accurate_and_consistent(render_sequence(load_scene("lakeshore"), 0, 120), {0.5, 0.06});
}

TEST(RenderedAccuracy, WalkAlongACorridor) {
  // Seed 1: 0.026 %, 0.0022.
  expect_accurate_and_consistent(part_of(corridor_sequence(), 0, 120), {0.051, 0.0044});
}

// The vehicle stops and turns by 120 degrees, away from everything that it has seen: heading and scale are
// preserved.
TEST(RenderedAccuracy, PureRotation) {
  constexpr int kBegin = 80, kTurn = 130, kTurned = 232, kEnd = 270;
  const RenderedSequence sequence = render_sequence(load_scene("rotation"), kBegin, kEnd);
  for_each_seed(sequence.clip, sequence.truth, [&](const RunAccuracy& figures) {
    const auto& frames = figures.run.frames;
    EXPECT_EQ(figures.completion, 1);
    for (const FrameRecord& frame : frames) EXPECT_EQ(frame.segment, 0) << "frame " << frame.index;
    const auto found = [&](int i) { return *frames[size_t(i - kBegin)].T_world_cam; };
    const auto truth = [&](int i) { return sequence.truth.poses[size_t(i - kBegin)].T_world_cam; };
    const auto turn = [&](const auto& pose_of) { return pose_of(kTurn).inverse() * pose_of(kTurned); };
    const double heading_deg = (turn(found).inverse() * turn(truth)).angle() * 180 / M_PI;
    // Path length before the stop against that after it, estimated and true.
    const auto distance = [&](int a, int b, const auto& pose_of) {
      return (pose_of(b).translation() - pose_of(a).translation()).norm();
    };
    const auto ratio = [&](const auto& pose_of) {
      return distance(kTurned, kEnd - 1, pose_of) / distance(kBegin + 10, kTurn - 15, pose_of);
    };
    const double kept = ratio(found) / ratio(truth);
    std::cout << "[ figures  ] heading off by " << heading_deg << " degrees, length after over before "
              << kept << std::endl;
    EXPECT_LT(heading_deg, 1.0);
    EXPECT_GT(kept, 0.6);
    EXPECT_LT(kept, 1.6);
  });
}

// The same images in other light.
RenderedSequence relit(const RenderedSequence& sequence, const Relight& relight) {
  RelitSource source(std::make_unique<ClipSource>(sequence.clip), relight);
  return {read_clip(source, [](int) { return true; }), sequence.truth};
}

// Degrees by which the headings of a run are off at most, by that of its first pose.
double worst_heading_deg(const Run& run, const Trajectory& truth) {
  std::optional<Eigen::Quaterniond> R_true_found;
  double worst = 0;
  for (size_t i = 0; i < run.frames.size(); ++i) {
    if (!run.frames[i].T_world_cam) continue;
    const Eigen::Quaterniond found = run.frames[i].T_world_cam->rotation(),
                             right = truth.poses[i].T_world_cam.rotation();
    if (!R_true_found) R_true_found = right * found.conjugate();
    worst = std::max(worst, (*R_true_found * found).angularDistance(right) * 180 / M_PI);
  }
  return worst;
}

// In a pure rotation the map's unit is in doubt, which is no reason to doubt the gyro: without it the
// edges of a map whose depths are guesses turn by as much as fits them best.
TEST(RenderedAccuracy, AGyroHoldsTheHeadingWhereTheUnitIsInDoubt) {
  // Off by 0.26 degrees; by 14 where the gyro is doubted. Of other seeds by up to 2.2.
  constexpr uint64_t kScene = 5, kSeed = 2;
  constexpr int kEnd = 270;
  const Scene scene = load_scene("rotation", kScene);
  const RenderedSequence sequence = relit(render_sequence(scene, 0, kEnd), Relight("mixed", kScene));
  const std::vector<GyroSample> gyro =
      simulate_gyro(scene.T_scene_cam_at, -0.5, scene.times[kEnd].seconds() + 0.5, "phone", scene.seed)
          .samples;
  ClipSource source(sequence.clip);
  const double worst_deg = worst_heading_deg(run_source(source, gyro, kSeed), sequence.truth);
  std::cout << "[ figures  ] heading off by " << worst_deg << " degrees" << std::endl;
  EXPECT_LT(worst_deg, 1);
}

// Where all edges run along the motion, glare and shadows outvote the few points that constrain the distance
// travelled. Without the measures of lab 2026-11-23_motion_outliers the ATE is 14 to 18 % of
// the path, seeds 1 and 2; with them 0.2 to 0.4 %.
TEST(RenderedAccuracy, ACorridorInBadLight) {
  // Seed 1: 0.38 %, 0.070.
  expect_sequence_within(part_of(relit(corridor_sequence(), Relight("mixed", 5)), 60, 200), {0.8, 0.14});
}

// A recorder drops frames, up to six in a row, which only the times show (frame_clock.h). With a prediction
// by a single median step, the camera is lost at the gaps: 6.9 % of the path; with the clock 0.02 %.
TEST(RenderedAccuracy, AStreetWithFramesMissing) {
  // Seed 1: 0.036 %, 0.0030.
  expect_sequence_within({with_gaps(*street_sequence().clip, 1), street_sequence().truth}, {0.071, 0.006});
}

// Black except for an ellipse over 84 % of the width and 96 % of the height: the part of the sensor that a
// lens illuminates, or the part of an image that undistortion fills.
std::shared_ptr<const Clip> through_round_lens(Clip clip) {
  for (Frame& frame : clip.frames) {
    const double w = frame.image.width, h = frame.image.height;
    for (int y = 0; y < frame.image.height; ++y)
      for (int x = 0; x < frame.image.width; ++x)
        if (std::hypot((x - w / 2) / (0.42 * w), (y - h / 2) / (0.48 * h)) > 1)
          frame.image.pixels[size_t(y) * frame.image.width + x] = 0;
  }
  return std::make_shared<const Clip>(std::move(clip));
}

// The outline of the border mask is no edge of the scene (segmentation/src/border_mask.h).
TEST(RenderedAccuracy, AStreetThroughARoundLens) {
  // Seeds 1 to 5: up to 0.041 %, 0.0027.
  expect_sequence_within({through_round_lens(*street_sequence().clip), street_sequence().truth},
                         {0.082, 0.0054});
}

// Through a bend of 26 degrees between two frames. Edges alone lose it (two to three segments, ATE 5 % of the
// path, seeds 1 to 3); corners hold it (features/corner_motion.h).
TEST(RenderedAccuracy, ABendAtGreatSpeed) {
  const auto renderer = std::make_shared<SceneRenderer>(load_scene("street"));
  SourceOptions some;
  some.first = 210, some.last = 306, some.every = 8;
  const auto source = subsample(std::make_unique<RenderedSource>(renderer), some);
  expect_sequence_within(
      {read_clip(*source, [](int) { return true; }), truth_of(renderer->scene(), 210, 306)}, {0.8, 0.2});
}

// That a distortion missing in the camera file is found, tests/integration/cli_calibrate.sh checks.
TEST(SelfCalibration, LeavesAnExactCameraAlone) {
  const RenderedSequence street = part_of(street_sequence(), 0, 80);
  ClipSource source(street.clip);
  const CameraPosterior camera = run_source(source).camera;
  EXPECT_NE(camera.state_of(CameraNumber::kK1), CameraPosterior::State::kApplied);
  EXPECT_EQ(camera.applied.k1, 0);
  EXPECT_NE(camera.state_of(CameraNumber::kReadout), CameraPosterior::State::kApplied);
  EXPECT_EQ(camera.applied.readout_s, 0);
}

// Corners do not show an error that is so small; the matches of some twenty keyframes do.
TEST(SelfCalibration, CorrectsAFocalLengthThatIsFivePercentOff) {
  const RenderedSequence& desk = desk_sequence();
  for (const double by_file : {0.95, 1.05}) {
    Clip clip = *desk.clip;
    Pinhole pinhole = clip.camera.pinhole();
    pinhole.fx *= by_file, pinhole.fy *= by_file;
    clip.camera.set_pinhole(pinhole);
    ClipSource source(std::make_shared<const Clip>(std::move(clip)));
    const RunAccuracy figures = measure(run_source(source), desk.truth);
    const CameraPosterior& camera = figures.run.camera;
    std::cout << "[ figures  ] focal length " << camera.applied.focal << ", +- " << camera.focal_sigma()
              << ", ATE " << figures.ate_percent << " %" << std::endl;
    EXPECT_NEAR(camera.applied.focal, 1 / by_file - 1, 0.0105);
    EXPECT_LT(figures.ate_percent, 0.25);
  }
}

// A rolling shutter, as nearly all webcams and phones have, which no calibration file describes.
TEST(SelfCalibration, FindsTheRollingShutterOfAHandHeldCamera) {
  Scene scene = load_scene("desk");
  scene.shutter.rolling_s = 0.02;
  const RenderedSequence sequence = render_sequence(scene, 0, 170);
  for_each_seed(sequence.clip, sequence.truth, [](const RunAccuracy& figures) {
    const CameraPosterior& camera = figures.run.camera;
    const double readout_s = figures.run.camera.applied.readout_s;
    std::cout << "[ figures  ] read-out " << readout_s << " s, +- "
              << camera.given.sigma_of(CameraNumber::kReadout) << std::endl;
    EXPECT_EQ(camera.state_of(CameraNumber::kReadout), CameraPosterior::State::kApplied);
    EXPECT_NEAR(readout_s, 0.02, 0.007);
    EXPECT_EQ(figures.completion, 1);
    EXPECT_LT(figures.ate_percent, 0.15);
  });
}

// A walk whose turns make every frame doubtful until the read-out time is known, which is found all the same.
TEST(SelfCalibration, FindsTheRollingShutterThatMakesTheMapDoubtful) {
  Scene scene = load_scene("office_walk", 11);
  scene.shutter.rolling_s = 0.03;
  const RenderedSequence sequence = render_sequence(scene, 0, 45);
  ClipSource source(sequence.clip);
  const RunAccuracy figures = measure(run_source(source), sequence.truth);
  std::cout << "[ figures  ] " << figures << std::endl;
  EXPECT_NEAR(figures.run.camera.applied.readout_s, scene.shutter.rolling_s, 0.008);
  EXPECT_EQ(figures.completion, 1);
}

// A walk that begins in a turn of 7 degrees a frame: the rows of each view of the first map are skewed in
// their own way. With the skews the local scale falls to a sixth and rises to twice its value within twelve
// frames.
TEST(RollingShutter, TheFirstMapIsMadeOfStraightRows) {
  Scene scene = load_scene("office_walk");
  scene.shutter.rolling_s = 0.022;
  const RenderedSequence sequence = render_sequence(scene, 0, 40);
  OdometryParams params;
  params.camera.readout_s = scene.shutter.rolling_s;
  for (const uint64_t seed : test_seeds()) {
    ClipSource source(sequence.clip);
    const RunAccuracy figures = measure(run_source(source, params, seed), sequence.truth);
    std::cout << "[ figures  ] seed " << seed << ": " << figures << std::endl;
    EXPECT_LT(figures.scale_drift, 0.05);
    EXPECT_EQ(figures.completion, 1);
  }
}

// Real sequences in EDGEVO_DATA_DIR; skipped where they are missing.
class RealAccuracy : public ::testing::Test {
 protected:
  static void expect_sequence(const std::string& name, int frames, int every, const Bounds& bounds,
                              bool in_another_pinhole = false) {
    const fs::path folder = fs::path(EDGEVO_DATA_DIR) / name;
    if (!fs::is_directory(folder)) {
      GTEST_SKIP() << "NOT TESTED: there is no " << folder
                   << "; configure with -DEDGEVO_DATA_DIR=DIR to test accuracy on "
                   << "real images";
    }
    SourceOptions options;
    options.path = folder.string();
    options.last = frames;
    options.every = every;
    const auto source = open_source(options);
    std::optional<Pinhole> working_pinhole;
    if (in_another_pinhole) working_pinhole = wider_and_smaller(source->camera().pinhole());
    expect_sequence_within({read_clip(*source, [](int) { return true; }),
                            read_trajectory((folder / "groundtruth_tum.txt").string())},
                           bounds, working_pinhole);
  }
};

// Seed 1: 0.20 %, 0.075; 0.090 %, 0.0048; 0.16 %, 0.018.
TEST_F(RealAccuracy, KittiDrive) { expect_sequence("kitti00_first300", 100, 1, {0.4, 0.15}); }

TEST_F(RealAccuracy, KittiDriveEveryThirdFrame) {
  expect_sequence("kitti05_first300", 120, 3, {0.18, 0.0095});
}

// A turn of 90 degrees, up to 16 between two frames.
TEST_F(RealAccuracy, KittiTurnEveryFourthFrame) {
  expect_sequence("kitti00_first300", 300, 4, {0.32, 0.036});
}

TEST_F(RealAccuracy, HandHeldOverAnOfficeDesk) {
  expect_sequence("tum_fr1_xyz_first500", 150, 1, {2.0, 0.5});
}

// Seeds 1 and 2: up to 0.32 %, 0.060; in the camera's own pinhole 0.29 %, 0.036.
TEST_F(RealAccuracy, HandHeldOverAnOfficeDeskInAnotherPinhole) {
  expect_sequence("tum_fr1_xyz_first500", 150, 1, {0.64, 0.12}, true);
}

}  // namespace
}  // namespace edgevo::test
