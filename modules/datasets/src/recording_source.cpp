// SPDX-License-Identifier: BSD-3-Clause
#include "recording_source.h"

#include <cmath>
#include <utility>

#include "assumed_camera.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/bad_frame.h"
#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/core/gyro_of_sensors.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/time_order.h"
#include "edgevo/mrpt_bridge/intensities.h"
#include "recorded_camera.h"
#include "recorded_image.h"
#include "recorded_sensors.h"
#include "recording_topics.h"
#include "sequence.h"

namespace edgevo {
namespace {

using Decisions = std::vector<InputDecision>;

// Of the first images, as far as they have more than 8 bits.
IntensityCount count_intensities(Recording* recording, const ImageTopic& image) {
  IntensityCount count;
  recording->select({{image.topic}});
  while (count.images() < kIntensitySamples) {
    const auto message = recording->next();
    if (!message) break;
    GrayImage gray = decode_recorded(message->bytes, image, std::nullopt, image.name).image;
    if (!gray.is_deep()) break;
    count.add({gray.width, gray.height, std::move(gray.values)});
  }
  return count;
}

Intensities intensities_of(Recording* recording, const ImageTopic& image, int bits) {
  IntensityCount count;
  try {
    count = count_intensities(recording, image);
  } catch (const InputError&) {  // reported when it is played
  }
  return decide_intensities(count, bits, std::to_string(count.images()) + " images of the recording");
}

// Which times are taken, where that matters: more than a frame lies between the stamps and the recorder's
// clock.
void decide_times(const ImageTopic& image, Decisions* decisions) {
  if (image.stamps.empty()) return;
  if (image.has_no_stamps()) {
    decisions->push_back({"times", "as recorded", "the headers have no stamps", ""});
    return;
  }
  constexpr double kOtherClock = 3600;  // seconds
  const double late = seconds_between(image.stamps.back(), image.recorded.back()), step = image.step_s();
  if (step <= 0 || std::abs(late) <= step) return;
  const std::string away = std::abs(late) > kOtherClock ? "the recorder had another clock"
                                                        : "recorded " + fixed(std::abs(late), 3) + " s " +
                                                              (late > 0 ? "later, " : "earlier, ") +
                                                              fixed(std::abs(late) / step, 1) + " frames";
  decisions->push_back({"times", "the stamps of the headers", away, ""});
}

std::string uncalibrated(const std::optional<FoundCameraInfo>& info) {
  return info ? info->topic + " says that the camera is not calibrated (K is zero)"
              : "it has no sensor_msgs/CameraInfo for the images";
}

// That of the user, else of CameraInfo, else an assumed one.
Camera choose_camera(Recording* recording, const ImageTopic& image, const SourceOptions& options,
                     Decisions* decisions) {
  const SeenImages seen{{}, image.width, image.height, 0};
  if (!options.camera_file.empty()) return camera_of_file(camera_file_of(options, ""), seen, decisions);
  std::optional<FoundCameraInfo> info;
  try {
    info = find_camera_info(recording, image, options.path);
    if (info) {
      const std::string where = options.path + ", " + info->topic;
      const bool is_rectified = names_rectified(image.name);
      if (const auto camera =
              camera_of_info(info->message, is_rectified, image.width, image.height, where, decisions)) {
        if (is_rectified)
          decisions->push_back({"rectified", "the images are", "by the name of their topic", ""});
        return *camera;
      }
    }
  } catch (const InputError&) {
    if (!options.any_camera && !options.fov_deg) throw;
  }
  if (!options.any_camera && !options.fov_deg)
    throw InputError(options.path, uncalibrated(info),
                     "give --camera FILE, or --camera auto to find the camera from the motion");
  Camera camera = choose_or_assume_camera(options, "", seen, decisions);
  if (!decisions->empty() && decisions->back().subject == "camera") {
    std::string& reason = decisions->back().reason;
    reason = uncalibrated(info) + (reason.empty() ? "" : "; ") + reason;
  }
  return camera;
}

class RecordingSource : public ImageSource {
 public:
  explicit RecordingSource(const SourceOptions& options)
      : path_(options.path),
        recording_(open_recording(path_)),
        image_(choose_image_topic(recording_.get(), path_, options.topic)),
        camera_(choose_camera(recording_.get(), image_, options, &decisions_)),
        intensities_(intensities_of(recording_.get(), image_, options.bits)),
        frames_(read_static_frames(recording_.get())),
        vehicle_(frames_.vehicle_frame(image_.frame)) {
    if (!vehicle_.empty()) T_vehicle_cam_ = frames_.between(vehicle_, image_.frame);
    decide();
    recording_->select({{image_.topic}});
  }

  const Camera& camera() const override { return camera_; }
  std::optional<SE3> T_vehicle_cam() const override { return T_vehicle_cam_; }
  std::optional<int> size() const override {
    return image_.images ? std::make_optional(int(*image_.images)) : std::nullopt;
  }
  std::string kind() const override { return recording_->kind(); }
  std::string label() const override { return image_.name; }
  VehicleTrack vehicle_track(VehicleSensor sensor) const override {
    return has_sensors(*recording_) ? read_recorded_track(sensor_context(), sensor) : VehicleTrack();
  }
  SensorReadings sensor_readings() const override {
    return has_sensors(*recording_) ? read_sensors(sensor_context()) : SensorReadings();
  }
  GyroReadings gyro_readings() const override { return gyro_of(sensor_readings()); }
  std::vector<std::pair<std::string, std::string>> details() const override;
  Decisions decisions() const override { return decisions_; }
  std::vector<Timestamp> times() const override;
  std::optional<Frame> next() override;
  bool skip() override;

 private:
  void decide();
  SensorContext sensor_context() const { return {path_, frames_, vehicle_, image_.name, times()}; }
  std::string where() const { return path_ + ", frame " + std::to_string(index_) + " of " + image_.name; }
  Timestamp time_of(Timestamp stamp, int64_t recorded_ns) const {
    return image_.has_no_stamps() ? Timestamp::from_nanoseconds(recorded_ns) : stamp;
  }
  std::optional<RecordedMessage> advance();
  Timestamp stated_time(const RecordedMessage& message, const std::string& where) const;

  std::string path_;
  Decisions decisions_;
  std::unique_ptr<Recording> recording_;
  ImageTopic image_;
  Camera camera_;
  Intensities intensities_;
  StaticFrames frames_;
  std::string vehicle_;
  std::optional<SE3> T_vehicle_cam_;
  mutable std::optional<std::vector<Timestamp>> times_;
  TimeOrder order_;
  Timestamp last_;
  int index_ = 0;
};

void RecordingSource::decide() {
  if (!recording_->missing().empty())
    decisions_.insert(decisions_.begin(),
                      {"recording", recording_->missing(), "all that is whole is used", ""});
  decide_times(image_, &decisions_);
  if (intensities_.decision) decisions_.push_back(*intensities_.decision);
  constexpr double kUp = 60;  // degrees
  if (!T_vehicle_cam_ || T_vehicle_cam_->R()(2, 2) < std::sin(rad(kUp))) return;
  decisions_.push_back(
      {"frames", "the camera looks up", "by /tf_static, " + image_.frame + " in " + vehicle_,
       "The frame of the images may be that of the camera's body (x forward), not of its optical "
       "axis (z forward): give --mount."});
}

std::vector<std::pair<std::string, std::string>> RecordingSource::details() const {
  std::vector<std::pair<std::string, std::string>> details;
  details.emplace_back("topic", image_.name + " (" + image_.encoding + ")");
  details.emplace_back("all topics", list_topics(*recording_));
  if (T_vehicle_cam_) details.emplace_back("mount by", "/tf_static, " + image_.frame + " in " + vehicle_);
  return details;
}

// Reads the heads of all images once.
std::vector<Timestamp> RecordingSource::times() const {
  if (times_) return *times_;
  times_.emplace();
  const auto recording = open_recording(path_);
  recording->select({{image_.topic}, kHeaderBytes});
  for (bool more = true; more;) try {
      const auto message = recording->next();
      more = message.has_value();
      if (more) times_->push_back(stated_time(*message, image_.name));
    } catch (const InputError&) {
      times_->push_back(kNoTime);
    }
  return *times_;
}

Timestamp RecordingSource::stated_time(const RecordedMessage& message, const std::string& where) const {
  return time_of(decode_header(message.bytes, image_.serialization, where).stamp, message.recorded_ns);
}

// A part that cannot be read is one bad frame.
std::optional<RecordedMessage> RecordingSource::advance() try {
  return recording_->next();
} catch (const DamagedPart& e) {
  throw BadFrame(index_++, last_, e);
}

std::optional<Frame> RecordingSource::next() {
  const auto message = advance();
  if (!message) return std::nullopt;
  const std::string where = this->where();
  const int index = index_++;
  Timestamp stated = kNoTime;
  try {
    stated = stated_time(*message, where);
  } catch (const InputError& e) {
    throw BadFrame(index, last_, e);
  }
  last_ = order_.require(index, stated, std::nullopt, where);
  try {
    RecordedImage recorded = decode_recorded(message->bytes, image_, intensities_.scale, where);
    if (!intensities_.scale && recorded.image.is_deep())
      throw InputError(where, "the image has 16 bits, but the first images have 8",
                       "convert all to the same depth");
    check_image_size(recorded.image, camera_.pinhole(), where);
    return Frame{index, last_, std::move(recorded.image)};
  } catch (const InputError& e) {
    throw BadFrame(index, last_, e);
  }
}

bool RecordingSource::skip() try {
  if (!advance()) return false;
  ++index_;
  return true;
} catch (const BadFrame&) {
  return true;
}

}  // namespace

std::unique_ptr<ImageSource> open_recording_source(const SourceOptions& options) {
  return std::make_unique<RecordingSource>(options);
}

}  // namespace edgevo
