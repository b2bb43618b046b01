// SPDX-License-Identifier: BSD-3-Clause
// The first look at a recording with a gyro: its rolling shutter is found before the map is made.
#include "first_look.h"

#include <gmock/gmock.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "edgevo/run_loop/run_odometry.h"
#include "unit/odometry/hand_source.h"
#include "unit/odometry/rendered_runs.h"

namespace edgevo::test {
namespace {

using ::testing::HasSubstr;

struct HandRun {
  RunResult result;
  std::string log;
  double error() const { return trajectory_error(result.run, 0, kHandFrames, hand_at_frame).rmse; }
};

HandRun run_hand(double readout_s, const std::vector<GyroSample>& gyro) {
  HandSource source(readout_s, gyro);
  HandRun run;
  RunLoopOptions options;
  options.odometry.log = [&](const std::string& line) { run.log += line + "\n"; };
  run.result = run_odometry(source, {}, options, [](const ProcessedFrame&) { return true; });
  return run;
}

TEST(FirstLook, ARollingShutterIsKnownFromTheFirstFrameOn) {
  constexpr double kReadoutS = 0.03;
  const std::vector<GyroSample> gyro = phone_in_hand(), none;
  const HandRun with = run_hand(kReadoutS, gyro), without = run_hand(kReadoutS, none);
  EXPECT_THAT(with.log, HasSubstr("the first frames show a rolling shutter"));
  EXPECT_EQ(with.result.run.camera.state_of(CameraNumber::kReadout), CameraPosterior::State::kApplied);
  EXPECT_NEAR(with.result.run.camera.applied.readout_s, kReadoutS, 0.003);
  EXPECT_EQ(with.result.run.frames.size(), size_t(kHandFrames));
  EXPECT_LT(with.error(), 0.6 * without.error());
}

TEST(FirstLook, AGlobalShutterChangesNothing) {
  const std::vector<GyroSample> gyro = phone_in_hand();
  const HandRun looked = run_hand(0, gyro);
  EXPECT_THAT(looked.log, Not(HasSubstr("rolling")));
  Odometry odometry(HollowScene().camera);
  HandSource source(0, gyro);
  for (size_t next = 0; auto frame = source.next();) {
    for (; next < gyro.size() && gyro[next].time.seconds() < frame->time.seconds() + 0.3; ++next)
      odometry.add_gyro(gyro[next]);
    odometry.process(*frame);
  }
  EXPECT_EQ(trajectory_error(odometry.finish(), 0, kHandFrames, hand_at_frame).rmse, looked.error());
}

TEST(FirstLook, IsForRecordingsWithAGyroWhoseReadOutTimeIsSought) {
  const std::vector<GyroSample> gyro = phone_in_hand(), none;
  const HandSource with(0, gyro), without(0, none);
  EXPECT_TRUE(takes_first_look(with, {}, {}));
  EXPECT_FALSE(takes_first_look(without, {}, {}));
  OdometryOptions realtime;
  realtime.realtime = true;
  EXPECT_TRUE(takes_first_look(with, {}, realtime));
  realtime.on_schedule = true;
  EXPECT_FALSE(takes_first_look(with, {}, realtime));
  OdometryParams known;
  known.camera.readout_s = 0.02;
  EXPECT_FALSE(takes_first_look(with, known, {}));
  known = {};
  known.camera.refine = "none";
  EXPECT_FALSE(takes_first_look(with, known, {}));
}

// Two frames, a fault, one frame, the end.
class FaultySource : public ImageSource {
 public:
  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return 3; }
  std::string kind() const override { return "faulty"; }
  std::optional<Frame> next() override {
    const int call = calls_++;
    if (call == 2) throw std::runtime_error("a fault");
    if (call > 3) return std::nullopt;
    return Frame{call, Timestamp::from_seconds(call), {}};
  }

 private:
  Camera camera_;
  int calls_ = 0;
};

// The indices of the frames until the end; a fault as -1.
std::vector<int> read_all(ImageSource* source) {
  std::vector<int> read;
  for (;;) try {
      const std::optional<Frame> frame = source->next();
      if (!frame) return read;
      read.push_back(frame->index);
    } catch (const std::runtime_error&) {
      read.push_back(-1);
    }
}

TEST(FirstFrames, AreReadTwiceWithTheirFaults) {
  const std::vector<int> all{0, 1, -1, 3};
  FaultySource once;
  FirstFrames plain(once);
  EXPECT_EQ(read_all(&plain), all);

  FaultySource twice;
  FirstFrames frames(twice);
  frames.keep();
  for (int call = 0; call < 2; ++call) EXPECT_EQ(frames.next()->index, call);
  EXPECT_THROW(frames.next(), std::runtime_error);
  frames.read_again();
  EXPECT_EQ(read_all(&frames), all);
}

}  // namespace
}  // namespace edgevo::test
