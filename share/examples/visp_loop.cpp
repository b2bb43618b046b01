// SPDX-License-Identifier: BSD-3-Clause
// A visual-servoing loop with edgevo as its sensor.
//
//   visp_loop SOURCE [PACE]
//
// SOURCE: a folder, rawlog or video, as for `edgevo run`. PACE: playback speed; 0.5 plays at half the rate.
//
// Three threads, as on a robot: the camera pushes images, the odometry processes them, and the loop
// reads the newest pose at 20 Hz. The first usable pose is taught as the goal; from then on PBVS steers back
// to it. Commands are printed instead of sent to a robot.
#include <edgevo/core/error.h>
#include <edgevo/datasets/open_source.h>
#include <edgevo/visp_bridge/conversions.h>
#include <edgevo/visp_bridge/servo_odometry.h>
#include <edgevo/visp_bridge/servo_params.h>
#include <visp3/visual_features/vpFeatureThetaU.h>
#include <visp3/visual_features/vpFeatureTranslation.h>
#include <visp3/vs/vpServo.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kPeriod(50);  // 20 Hz

// Images and loop must use one clock.
edgevo::Timestamp now() {
  return edgevo::Timestamp::from_nanoseconds(
      std::chrono::nanoseconds(Clock::now().time_since_epoch()).count());
}

// Prints the commands; with a real robot, call robot.setVelocity(vpRobot::CAMERA_FRAME, v).
class PrintingRobot {
 public:
  void set_velocity(const vpColVector& v) {
    last_stop_.clear();
    if (++commands_ % 10 == 1)
      std::printf("move  %6.3f %6.3f %6.3f  %6.3f %6.3f %6.3f\n", v[0], v[1], v[2], v[3], v[4], v[5]);
  }
  void stop(const std::string& why) {
    const std::string kind = why.substr(0, why.find(':'));
    if (kind != last_stop_) std::printf("stop  %s\n", why.c_str());
    last_stop_ = kind;
  }

 private:
  int commands_ = 0;
  std::string last_stop_;
};

// PBVS: drives the pose of the camera in the frame of the taught camera to the identity.
class PositionLaw {
 public:
  explicit PositionLaw(const vpHomogeneousMatrix& cdMw)
      : cdMw_(cdMw), t_(vpFeatureTranslation::cdMc), tu_(vpFeatureThetaU::cdRc) {
    task_.setServo(vpServo::EYEINHAND_CAMERA);
    task_.setInteractionMatrixType(vpServo::CURRENT);
    task_.setLambda(0.8);  // keep gain times latency well under 1
    task_.addFeature(t_);
    task_.addFeature(tu_);
  }
  vpColVector velocity(const vpHomogeneousMatrix& cMw) {
    const vpHomogeneousMatrix cdMc = cdMw_ * cMw.inverse();
    t_.buildFrom(cdMc);
    tu_.buildFrom(cdMc);
    return task_.computeControlLaw();
  }

 private:
  vpHomogeneousMatrix cdMw_;
  vpFeatureTranslation t_;
  vpFeatureThetaU tu_;
  vpServo task_;
};

// The camera thread: delivers each image at its time. A real program would grab from a device here.
void play(edgevo::ImageSource& source, double pace, edgevo::ServoOdometry* odometry) {
  std::optional<edgevo::Timestamp> first;
  const Clock::time_point begin = Clock::now();
  while (std::optional<edgevo::Frame> frame = source.next()) {
    if (!first) first = frame->time;
    const double due_s = edgevo::seconds_between(*first, frame->time) / pace;
    std::this_thread::sleep_until(
        begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due_s)));
    odometry->push(std::move(frame->image), now());
  }
}

void servo_loop(const edgevo::ServoFeed& feed, const std::atomic<bool>& images_end) {
  PrintingRobot robot;
  std::unique_ptr<PositionLaw> law;
  int taught_map = -1;
  for (Clock::time_point tick = Clock::now();; tick += kPeriod) {
    std::this_thread::sleep_until(tick);
    const edgevo::ServoPose pose = feed.pose(now());
    if (!pose.usable) {
      robot.stop(pose.reason);  // lost, stale or not available yet: the robot must stop
      if (images_end) return;
      continue;
    }
    if (!law) {
      std::printf("taught at image %d; scale: %s\n", pose.frame_index, pose.scale.source.c_str());
      law = std::make_unique<PositionLaw>(pose.cMw);
      taught_map = pose.map_version;
    }
    if (pose.map_version != taught_map)
      robot.stop("new map: the goal was taught in another one");
    else
      robot.set_velocity(law->velocity(pose.cMw));
  }
}

int run(const std::string& path, double pace) {
  edgevo::SourceOptions options;
  options.path = path;
  const std::unique_ptr<edgevo::ImageSource> source = edgevo::open_source(options);
  edgevo::OdometryOptions odometry_options;
  odometry_options.realtime = true;
  edgevo::ServoFeed feed;
  edgevo::ServoOdometry odometry(source->camera(), edgevo::servo_odometry_params(), odometry_options, &feed);
  std::atomic<bool> images_end{false};
  std::exception_ptr broken;
  std::thread camera([&] {
    try {
      play(*source, pace, &odometry);
    } catch (...) {
      broken = std::current_exception();
    }
    images_end = true;
  });
  servo_loop(feed, images_end);
  camera.join();
  const edgevo::Run result = odometry.finish();
  std::printf("%zu images processed, %d replaced by newer ones\n", result.frames.size(), odometry.replaced());
  if (broken) std::rethrow_exception(broken);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const double pace = argc > 2 ? std::atof(argv[2]) : 1;
  if (argc < 2 || argc > 3 || !(pace > 0)) {
    std::fprintf(stderr, "usage: visp_loop SOURCE [PACE larger than 0]\n");
    return 2;
  }
  try {
    return run(argv[1], pace);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "visp_loop: %s\n", e.what());
    return 2;
  }
}
