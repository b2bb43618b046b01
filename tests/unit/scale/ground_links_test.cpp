// SPDX-License-Identifier: BSD-3-Clause
// A drive that loses its unit of length in two seconds without sight, followed by its events.
#include "edgevo/scale/ground_links.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "drive_over_ground.h"
#include "edgevo/core/record_units.h"
#include "edgevo/map/frame_log.h"
#include "edgevo/map/run_builder.h"
#include "edgevo/scale/run_scale.h"

namespace edgevo {
namespace {

constexpr int kLost = 140, kSeen = 160, kCompared = 175;  // frames of 300
constexpr double kLengths = 0.35;                         // after over before
constexpr int kActive = 7;                                // keyframes

// Lengths after the gap become kLengths times as long.
test::MadeRun drive_with_a_gap(double ground_share = 0.6) {
  test::GroundDrive drive;
  drive.ground_share = ground_share;
  test::MadeRun made = test::drive_over_ground(drive);
  const Eigen::Vector3d pivot = made.run.frames[kSeen].T_world_cam->translation();
  const auto shorten = [&](SE3* T) {
    *T = SE3(T->rotation(), pivot + kLengths * (T->translation() - pivot));
  };
  for (FrameRecord& f : made.run.frames)
    if (f.index >= kSeen) shorten(&*f.T_world_cam), shorten(&*f.T_world_cam_live);
  for (KeyframeRecord& k : made.run.keyframes)
    if (k.frame_index >= kSeen) shorten(&k.T_world_cam), multiply_depths(kLengths, &k);
  return made;
}

// Appends the events of such a run to a log, as tracking and mapping do; the keyframe of frame 2 i has number
// i. The links of the ground are read from the same log.
class FollowedDrive {
 public:
  explicit FollowedDrive(test::MadeRun made) : made_(std::move(made)) { log_->append(SegmentPlaced{}); }

  // Up to, not including, a frame. Where two segments are wanted, the second one begins with kSeen.
  void drive_to(int end) {
    for (; next_ < end; ++next_) {
      if (next_ == kSeen && in_segments_) begin_segment();
      if (next_ >= kLost && next_ < kSeen && in_segments_)
        add_lost_frame();
      else
        add_frame();
      follow();
    }
  }
  void drive_in_segments() { in_segments_ = true; }
  void compare(RelativeScale found) {
    const int first = kSeen / 2 + 2, last_before = kLost / 2 - 1;
    FrameRecord compared = made_.run.frames[size_t(next_ - 1)];
    compared.evidence.unit = found;
    const FrameAnchor anchored = anchor(next_ - 1);
    Reference reference;
    reference.keyframe_id = anchored.keyframe_id, reference.median_idepth = 1;
    reference.T_ref_world = anchored.T_cam_ref.inverse() * anchored.T_cam_map;
    frames_.place(compared, 0, reference, anchored.T_cam_ref);
    if (!in_segments_) log_->append(EpochBegan{0, last_before, first});
    follow();
  }
  // All keyframes that were seen before the doubt, as another focal length shows them.
  void correct_focal_length(double focal) {
    MapMoved moved;
    moved.lens = LensChange{{}, {0, 0, focal}};
    moved.T_newest_map = anchor(kLost - 2).T_cam_map;
    for (int k = 0; k < kLost / 2; ++k) {
      KeyframeMove move;
      move.id = k;
      move.T_cam_newest = anchor(2 * k).T_cam_map * moved.T_newest_map.inverse();
      moved.keyframes.push_back(move);
    }
    links_.apply(MapEvent(moved));
  }
  void link_by_features(double ratio, double sigma) {
    log_->add_constraint(scale_constraint(ConstraintKind::kFeatures, NodeId::keyframe(kLost / 2 - 2),
                                          NodeId::keyframe(kSeen / 2 + 4), ratio, sigma));
  }

  edgevo::Run finish() {
    follow();
    frames_.run().adopt_window();
    return frames_.run().finish();
  }
  std::vector<ConstraintRecord> constraints() { return finish().constraints; }
  const test::MadeRun& made() const { return made_; }

 private:
  FrameAnchor anchor(int frame) const {
    const SE3 T_cam_map = made_.run.frames[size_t(frame)].T_world_cam->inverse();
    const SE3 T_cam_keyframe = T_cam_map * *made_.run.frames[size_t(frame / 2 * 2)].T_world_cam;
    return {frame / 2, T_cam_keyframe, T_cam_map, 0};
  }
  int segment() const { return in_segments_ && next_ >= kSeen ? 1 : 0; }
  KeyframeRecord keyframe(int k) const {
    KeyframeRecord record = made_.run.keyframes[size_t(k)];
    record.segment = in_segments_ && record.frame_index >= kSeen ? 1 : 0;
    return record;
  }
  void begin_segment() {
    while (oldest_ < next_ / 2) marginalise();
    SegmentPlaced placed;
    placed.segment = 1;
    placed.scale_sigma = 0.5, placed.rotation_sigma = 0.1, placed.position_sigma = 10;
    log_->append(placed);
  }
  void add_lost_frame() {
    FrameRecord frame;
    frame.index = next_;
    frame.state = TrackingState::kLost;
    log_->append(FrameAnchored{frame, std::nullopt});
  }
  void add_frame() {
    FrameRecord frame = made_.run.frames[size_t(next_)];
    frame.segment = segment();
    log_->append(FrameAnchored{frame, anchor(next_)});
    if (next_ % 2 != 0) return;
    log_->append(KeyframeAdded{next_ / 2, next_, segment()});
    if (oldest_ < kSeen / 2 && segment() == 1) oldest_ = kSeen / 2;
    if (next_ / 2 - oldest_ >= kActive) marginalise();
    auto window = std::make_shared<std::vector<WindowAdjusted::Active>>();
    for (int k = oldest_; k <= next_ / 2; ++k) window->push_back({k, keyframe(k)});
    log_->append(WindowAdjusted{0, window});
  }
  void marginalise() {
    if (!in_segments_ || 2 * oldest_ < kLost || 2 * oldest_ >= kSeen)
      log_->append(
          KeyframeMarginalised{oldest_, std::make_shared<const KeyframeRecord>(keyframe(oldest_)), {}});
    ++oldest_;
  }
  void follow() {
    for (const auto& event : cursor_.read()) links_.apply(*event);
    frames_.run();
  }

  test::MadeRun made_;
  const std::shared_ptr<MapLog> log_ = std::make_shared<MapLog>();
  MapCursor cursor_{log_};
  FrameLog frames_{made_.run.pinhole, log_};
  GroundLinks links_{made_.run.pinhole, std::nullopt, ScaleParams(), log_};
  bool in_segments_ = false;
  int next_ = 0, oldest_ = 0;
};

double length_between(const Run& run, size_t from, size_t to) {
  return (run.frames[to].T_world_cam->translation() - run.frames[from].T_world_cam->translation()).norm();
}
double true_length(const test::MadeRun& made, size_t from, size_t to) {
  return (made.truth[to].translation() - made.truth[from].translation()).norm() / 2;  // 2 metres a unit
}

FollowedDrive compared_drive(double ground_share, RelativeScale found = {}) {
  FollowedDrive drive(drive_with_a_gap(ground_share));
  drive.drive_to(kCompared + 1);
  drive.compare(found);
  return drive;
}

TEST(GroundLinks, TheCamerasHeightLinksWhatNothingElseDoes) {
  FollowedDrive drive = compared_drive(0.6);
  drive.drive_to(300);
  const edgevo::Run run = drive.finish();
  EXPECT_NEAR(length_between(run, 200, 280) / true_length(drive.made(), 200, 280), 1, 0.02);
  EXPECT_NEAR(length_between(run, 20, 100) / true_length(drive.made(), 20, 100), 1, 1e-6);
  ASSERT_EQ(run.constraints.size(), 1u) << "each statement replaces the one before";
  EXPECT_EQ(run.constraints[0].kind, "ground");
  EXPECT_TRUE(run.constraints[0].holds);
  EXPECT_LT(run.constraints[0].scale_sigma, 0.04);
  EXPECT_LT(std::abs(std::log(run.constraints[0].scale * kLengths)), 3 * run.constraints[0].scale_sigma);

  const auto& unit = run.frames[kCompared].evidence.unit;
  ASSERT_TRUE(unit && unit->is_linked());
  EXPECT_TRUE(unit->by_ground);
  EXPECT_EQ(unit->sigma, run.constraints[0].scale_sigma) << "the newest statement";
}

// Not only at the end of the run.
TEST(GroundLinks, ItLinksAsSoonAsTheGroundIsSeenAgain) {
  FollowedDrive drive = compared_drive(0.6);
  drive.drive_to(kCompared + 40);
  ASSERT_EQ(drive.constraints().size(), 1u);
}

// Heights that were measured with the focal length before, at the same depths.
TEST(GroundLinks, AnotherFocalLengthIsNoChangeOfTheUnit) {
  constexpr double kFocal = 0.25;
  for (const bool is_before_comparison : {true, false}) {
    FollowedDrive drive(drive_with_a_gap());
    drive.drive_to(kCompared + 1);
    if (is_before_comparison) drive.correct_focal_length(kFocal);
    drive.compare({});
    if (!is_before_comparison) drive.correct_focal_length(kFocal);
    drive.drive_to(300);
    const auto constraints = drive.constraints();
    ASSERT_EQ(constraints.size(), 1u);
    EXPECT_NEAR(constraints[0].scale * kLengths * (1 + kFocal), 1, 0.1);
  }
}

TEST(GroundLinks, TwoMapsAreLinkedToo) {
  FollowedDrive drive(drive_with_a_gap());
  drive.drive_in_segments();
  drive.drive_to(300);
  const edgevo::Run run = drive.finish();
  ASSERT_EQ(run.constraints.size(), 1u);
  EXPECT_NEAR(run.constraints[0].scale, 1 / kLengths, 0.1);
  EXPECT_NEAR(length_between(run, 200, 280) / true_length(drive.made(), 200, 280), 1, 0.02);
}

TEST(GroundLinks, WithoutGroundNothingIsLinked) {
  FollowedDrive drive = compared_drive(0);
  drive.drive_to(300);
  const edgevo::Run run = drive.finish();
  EXPECT_TRUE(run.constraints.empty());
  EXPECT_FALSE(run.frames[kCompared].evidence.unit->is_linked());
}

TEST(GroundLinks, WithoutADoubtNothingIsLinked) {
  FollowedDrive drive{test::drive_over_ground({})};
  drive.drive_to(300);
  EXPECT_TRUE(drive.constraints().empty());
}

TEST(GroundLinks, TheGraphWeighsItAgainstFeatures) {
  constexpr double kShorter = 0.7;
  for (const double sigma : {0.3, 0.001}) {
    FollowedDrive drive = compared_drive(0.6, {kShorter / kLengths, sigma});
    drive.link_by_features(kShorter / kLengths, sigma);
    drive.drive_to(300);
    const edgevo::Run run = drive.finish();
    const double by_ground = true_length(drive.made(), 200, 280);
    EXPECT_NEAR(length_between(run, 200, 280), sigma < 0.01 ? kShorter * by_ground : by_ground,
                0.05 * by_ground);
    EXPECT_FALSE(run.frames[kCompared].evidence.unit->by_ground) << "features had linked it";
  }
}

// Within the 40 m over which a scale is estimated both units would count.
TEST(GroundLinks, AGivenHeightIsMeasuredInEachUnitByItself) {
  test::MadeRun made = drive_with_a_gap();
  made.run.frames[kCompared].evidence.unit = RelativeScale();
  for (FrameRecord& f : made.run.frames)
    if (f.index >= kLost && f.index < kSeen)
      f.T_world_cam.reset(), f.segment = -1, f.state = TrackingState::kLost;
  const ScaleSource height{ScaleSource::Kind::kCameraHeight, 1.65, "camera_height=1.65"};
  const RunScale scale = estimate_run_scale(made.run, height, {}, ScaleParams());
  ASSERT_EQ(scale.problem, "");
  EXPECT_NEAR(scale.of_frame[kLost - 1].factor, 2, 0.05);
  EXPECT_NEAR(scale.of_frame[kSeen].factor, 2 / kLengths, 0.05 / kLengths);
}

}  // namespace
}  // namespace edgevo
