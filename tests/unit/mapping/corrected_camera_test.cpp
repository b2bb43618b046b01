// SPDX-License-Identifier: BSD-3-Clause
// A correction of the camera that is found next to mapping, and when it is applied. Run under ThreadSanitizer
// by the tsan preset.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <thread>

#include "sweep_driver.h"

namespace edgevo {
namespace {

using test::Sweep;
using test::SweepDriver;

constexpr int kKeyframeStep = 3;  // frames from keyframe to keyframe
constexpr int kLastSweepFrame = 150;
constexpr int kFirstEstimate = 10;  // keyframes

// Motion of the camera of the sweep while it takes a frame: so fast that a read-out time would show.
ImageMotion motion_at(int frame) {
  ImageMotion motion;
  constexpr double kFramesPerSecond = 100;
  motion.velocity =
      (test::sweep_pose(frame + 1).inverse() * test::sweep_pose(frame)).log() * kFramesPerSecond;
  const Pinhole p = Sweep::pinhole();
  for (int row = 0; row < ImageMotion::kRows; ++row)
    for (int column = 0; column < ImageMotion::kColumns; ++column)
      motion.idepth(row, column) = Sweep::idepth(frame, {(column + 0.5) * p.width / ImageMotion::kColumns,
                                                         (row + 0.5) * p.height / ImageMotion::kRows});
  return motion;
}

// A mapper that applies whatever it finds about a rolling shutter, and counts the images that are made again
// for it.
class CorrectedCamera : public testing::Test {
 protected:
  CorrectedCamera() {
    EXPECT_EQ(driver_.start(), "");
    frame_ = 8;
  }

  MapUpdate process(bool make_keyframe) {
    EXPECT_LE(++frame_, kLastSweepFrame);
    driver_.note_keyframes();
    TrackedFrame frame = driver_.align(frame_, make_keyframe);
    frame.motion = motion_at(frame_);
    const MapUpdate update = driver_.mapper.process(frame);
    driver_.note_keyframes();
    // From the first estimate on the threads next to mapping have time to finish, also on a slow machine.
    if (driver_.mapper.next_id() >= kFirstEstimate)
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return update;
  }
  MapUpdate make_keyframe() {
    frame_ += kKeyframeStep - 1;
    return process(true);
  }
  bool is_corrected() const { return driver_.mapper.camera().applied != ImageCorrection(); }
  int made_in_parallel() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return made_beside_;
  }
  int made_by_mapping() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return made_by_mapping_;
  }

 private:
  static MapperParams params() {
    MapperParams params = test::window_only(MappingParams());
    params.mapping.window.keyframes = 7;
    params.camera.refine = "readout";
    params.camera.min_keyframes = 3 * kFirstEstimate;
    params.camera.significance = 0;
    return params;
  }
  MapperOptions options() {
    MapperOptions options;
    options.own_threads = true;
    options.log = std::make_shared<MapLog>();
    options.rebuild = [this](const FramePyramid& old, const ImageMotion& motion,
                             const ImageCorrection& correction) {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++(std::this_thread::get_id() == mapping_ ? made_by_mapping_ : made_beside_);
      builder_.set_correction(correction);
      return builder_.rebuild(old, motion);
    };
    return options;
  }

  std::mutex mutex_;
  const std::thread::id mapping_ = std::this_thread::get_id();
  PyramidBuilder builder_ = PyramidBuilder::for_rebuilding(Sweep::pinhole(), EdgeParams());
  int made_beside_ = 0, made_by_mapping_ = 0;

 protected:
  SweepDriver driver_{params(), options()};  // its threads end before the rest does
  int frame_ = 0;
};

TEST_F(CorrectedCamera, IsAppliedBetweenKeyframesOnceAllImagesAreThere) {
  std::shared_ptr<const Reference> before;
  MapUpdate update;
  while (!is_corrected() && frame_ < kLastSweepFrame) {
    before = driver_.mapper.reference();
    // No keyframe comes while the images are made, however slow the machine is.
    update = process(made_in_parallel() == 0 && frame_ % kKeyframeStep == 0);
  }
  ASSERT_TRUE(is_corrected());
  EXPECT_EQ(update.keyframe_id, -1) << "the frame makes no keyframe";
  EXPECT_EQ(made_by_mapping(), 0) << "the map waits for no image";
  EXPECT_GE(made_in_parallel(), int(driver_.mapper.window().keyframes().size()));
  const ImageCorrection now = driver_.mapper.camera().applied;
  for (const Keyframe& k : driver_.mapper.window().keyframes()) EXPECT_EQ(k.pyramid->correction, now) << k.id;
  const auto after = driver_.mapper.reference();
  EXPECT_EQ(after->keyframe_id, before->keyframe_id);
  EXPECT_EQ(after->camera.applied, now);
  EXPECT_GT(after->moves, before->moves);
}

TEST_F(CorrectedCamera, IsLeftByKeyframesToTheFramesBetween) {
  while (made_in_parallel() == 0 && frame_ + kKeyframeStep < kLastSweepFrame) make_keyframe();
  ASSERT_GT(made_in_parallel(), 0) << "a correction was found";
  for (int k = 0; k < 4; ++k) {
    make_keyframe();
    EXPECT_FALSE(is_corrected()) << k;
  }
  for (int k = 0; k < 20 && !is_corrected(); ++k) process(false);
  EXPECT_TRUE(is_corrected());
}

// By then no image of the first round belongs to the window any more.
TEST_F(CorrectedCamera, IsAppliedByAKeyframeWhenTheWholeWindowHasChanged) {
  while (!is_corrected() && frame_ + kKeyframeStep < kLastSweepFrame) make_keyframe();
  EXPECT_TRUE(is_corrected());
}

}  // namespace
}  // namespace edgevo
