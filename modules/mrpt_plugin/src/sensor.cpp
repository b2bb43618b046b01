// SPDX-License-Identifier: BSD-3-Clause
#include "sensor.h"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/obs/CObservationComment.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/target_pinhole.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/places/view_locator.h"
#include "one_line.h"
#include "stop_signal.h"

namespace edgevo {

IMPLEMENTS_GENERIC_SENSOR(CEdgeVoSensor, edgevo)

CEdgeVoSensor::CEdgeVoSensor() { m_sensorLabel = config_.label; }

CEdgeVoSensor::~CEdgeVoSensor() {
  if (odometry_ && why_ended_.empty()) say(counts());
  try {
    if (const int appended = tail_.append_the_rest(); appended > 0)
      say(std::to_string(appended) +
          " observations that rawlog-grabber had left were appended to the rawlog");
  } catch (const std::exception& e) {
    say(one_line(e));
  }
}

void CEdgeVoSensor::say(const std::string& text) const {
  std::fprintf(stderr, "[%s] %s\n", section_.c_str(), text.c_str());
}

std::string CEdgeVoSensor::counts() const {
  return std::to_string(frames_) + " frames, " + std::to_string(poses_) + " with a pose" +
         (left_out_ > 0 ? ", " + std::to_string(left_out_) + " left out" : "");
}

// Errors of the .ini and of opening name the section, since a recording may have several.
void CEdgeVoSensor::name_section(const std::function<void()>& work) const {
  try {
    work();
  } catch (const std::exception& e) {
    throw std::runtime_error("[" + section_ + "] " + one_line(e));
  }
}

// Only stored here and parsed in initialize(): MRPT buries an exception thrown here under a call stack.
void CEdgeVoSensor::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config,
                                              const std::string& section) {
  section_ = section;
  m_grab_decimation = 0;  // CCameraSensor reads the key itself: a skipped frame costs no odometry
  ini_ = std::make_unique<mrpt::config::CConfigFileMemory>();
  std::vector<std::string> keys;
  config.getAllKeys(section, keys);
  for (const std::string& key : keys) ini_->write(section, key, config.read_string(section, key, ""));
}

void CEdgeVoSensor::setPathForExternalImages(const std::string& directory) {
  images_folder_ = directory;
  tail_.record_next_to(directory);
}

void CEdgeVoSensor::initialize() {
  m_state = ssError;  // until all is open
  listen_for_stop();
  name_section([&] { open(); });
  m_state = ssWorking;
}

// What becomes of a lens that is not plumb-bob: in the odometry, and in the observations of its images.
void CEdgeVoSensor::say_lens(const Camera& camera) const {
  if (camera.plumb_bob()) return;
  say(to_string(describe_target(camera, target_pinhole(camera))));
  if (const double error = closest_mrpt(camera).max_error_px; error > 0)
    say("camera: observations have the closest kannala_brandt lens, at most " + fixed(error, 2) +
        " px from it");
}

void CEdgeVoSensor::open() {
  if (!ini_) throw std::runtime_error("call loadConfig() first");
  config_ = read_sensor_config(*ini_, section_);
  m_sensorLabel = config_.label;
  grabber_ = open_grabber(*ini_, section_, config_.calibration_file);
  for (const InputDecision& decision : grabber_->decisions()) say(to_string(decision));
  for (const std::string& warning : input_warnings(grabber_->decisions())) say("WARNING: " + warning);
  say_lens(grabber_->camera());
  open_odometry();
  observations_ = std::make_unique<LiveObservations>(config_, grabber_->camera(), grabber_->T_vehicle_cam());
  if (config_.external_images && !images_folder_.empty()) {
    make_output_folder(images_folder_);
    observations_->set_images_folder(images_folder_);
  }
}

void CEdgeVoSensor::open_odometry() {
  OdometryOptions options;
  options.seed = uint64_t(config_.seed);
  options.realtime = config_.realtime;
  options.detectors = all_edge_detectors();
  options.log = [this](const std::string& line) { say(line); };
  options.map_log = std::make_shared<MapLog>();
  if (!config_.map.empty())
    earlier_.emplace(config_.map, rectification_of(grabber_->camera(), options).target(),
                     config_.metres_per_unit > 0 ? "metres_per_unit" : "");
  for (const std::string& line : earlier_ ? earlier_->warnings() : std::vector<std::string>()) say(line);
  PastParams params;
  params.kept = earlier_ ? earlier_->places() : nullptr;
  options.locate = locate_in(params.kept);
  past_.emplace(grabber_->camera(), grabber_->T_vehicle_cam(), options, params);
  events_.emplace(options.map_log);
  odometry_ = std::make_unique<Odometry>(grabber_->camera(), config_.odometry, options);
  gyro_ = GyroFeed(grabber_->gyro_readings());
}

void CEdgeVoSensor::doProcess() {
  if (!odometry_) throw std::runtime_error("CEdgeVoSensor: call initialize() first");
  if (why_ended_.empty() && stop_requested()) end("interrupted");
  if (!why_ended_.empty()) return end_when_all_is_written();
  tail_.all_written();  // releases what was written
  try {
    if (const auto grab = grabber_->next())
      process(*grab);
    else
      end("end of the input");
  } catch (const std::exception& e) {
    end(stop_requested() ? "interrupted" : one_line(e));
  }
}

void CEdgeVoSensor::process(const Grab& grab) {
  const FrameRecord record = track(grab);
  follow_past();
  ++frames_;
  if (grab.frame.image.empty()) return;
  const auto observations =
      observations_->make(grab, record, odometry_->newest_pose(), odometry_->frame_view());
  for (const auto& object : observations)
    if (const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object))
      tail_.add(observation);
  appendObservations(observations);
  newest_ = std::max(newest_, grab.stated_time);
  poses_ += record.T_world_cam_live.has_value();
}

// A recording must not end because of a single frame.
FrameRecord CEdgeVoSensor::track(const Grab& grab) {
  constexpr int kSaid = 10;  // a clock that stands still would fill the screen
  gyro_.feed_until(grab.frame.time, odometry_.get());
  if (grab.problem.empty()) return odometry_->process(grab.frame);
  if (left_out_++ < kSaid) say("frame " + std::to_string(grab.frame.index) + " left out: " + grab.problem);
  if (frames_ == left_out_ - 1) return {};  // no frame with a time came before
  return odometry_->skip(grab.frame, "left out: " + grab.problem);
}

void CEdgeVoSensor::follow_past() {
  past_->follow();
  const auto events = events_->read();
  if (!earlier_ || earlier_->is_placed()) return;
  earlier_->follow(events);
  if (!earlier_->is_placed()) return;
  if (earlier_->is_metric()) observations_->set_metres();
  say("found in the map " + config_.map + ", whose frame and unit the poses in `map` have" +
      (earlier_->is_metric() ? " (metres)" : ""));
}

// The comment is dated after all frames: the grabber never writes the newest object in its buffer.
void CEdgeVoSensor::end(const std::string& why) {
  why_ended_ = why;
  say(why + ", after " + counts());
  auto comment = mrpt::obs::CObservationComment::Create();
  comment->timestamp = to_mrpt(Timestamp{newest_.ticks + 1});
  comment->sensorLabel = config_.label + "_END";
  comment->text = why;
  appendObservation(comment);
}

void CEdgeVoSensor::end_when_all_is_written() {
  const bool to_end = config_.stop_at_end || stop_requested();
  if (!to_end || !tail_.all_written()) return;
  throw std::runtime_error("[" + section_ + "] " + why_ended_ + "; all " + std::to_string(frames_) +
                           " frames are in the rawlog");
}

}  // namespace edgevo
