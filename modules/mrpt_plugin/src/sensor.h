// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The odometry as a sensor of rawlog-grabber: any camera that CCameraSensor grabs, recorded with pose and 3D
// edges as it goes. Keys of its section: share/rawlog_grabber_*.ini.
#include <mrpt/hwdrivers/CGenericSensor.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "edgevo/map/map_log.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/run_loop/gyro_feed.h"
#include "edgevo/run_loop/kept_places.h"
#include "edgevo/run_loop/past_follower.h"
#include "live_observations.h"
#include "recording_tail.h"

namespace edgevo {

class CEdgeVoSensor : public mrpt::hwdrivers::CGenericSensor {
  DEFINE_GENERIC_SENSOR(CEdgeVoSensor)

 public:
  CEdgeVoSensor();
  /// Appends to the rawlog the observations that the grabber has not written.
  ~CEdgeVoSensor() override;

  void setPathForExternalImages(const std::string& directory) override;
  /// Opens camera and odometry. Throws std::runtime_error with a one-line message.
  void initialize() override;
  /// Processes one image. At the end of the images, or after Ctrl-C, reports it once, waits until all is
  /// written and then throws, which is how a sensor ends rawlog-grabber; with at_end = wait only after
  /// Ctrl-C.
  void doProcess() override;

 protected:
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config,
                                 const std::string& section) override;

 private:
  void name_section(const std::function<void()>& work) const;
  void open();
  void open_odometry();
  void process(const Grab& grab);
  FrameRecord track(const Grab& grab);
  void follow_past();
  void end(const std::string& why);
  void end_when_all_is_written();
  void say(const std::string& text) const;
  void say_lens(const Camera& camera) const;
  std::string counts() const;

  std::string section_;
  std::unique_ptr<mrpt::config::CConfigFileBase> ini_;  // the section
  SensorConfig config_;
  std::string images_folder_;
  std::unique_ptr<Grabber> grabber_;
  std::optional<KeptPlaces> earlier_;
  std::optional<PastFollower> past_;  // of odometry_
  std::optional<MapCursor> events_;
  std::unique_ptr<Odometry> odometry_;
  GyroFeed gyro_;
  std::unique_ptr<LiveObservations> observations_;
  RecordingTail tail_;
  Timestamp newest_;  // of what was recorded
  int frames_ = 0, poses_ = 0, left_out_ = 0;
  std::string why_ended_;  // empty while images come
};

}  // namespace edgevo
