// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_sensors.h"

#include <algorithm>
#include <map>
#include <utility>

#include "edgevo/core/earth_centred.h"
#include "edgevo/core/image_clock.h"

namespace edgevo {
namespace {

constexpr const char* kStaticTopic = "tf_static";

bool is_type(const RecordedTopic& topic, const std::string& type) {
  return topic.type == type && topic.serialization != Serialization::kOther;
}

bool is_static(const RecordedTopic& topic) {
  const size_t slash = topic.name.rfind('/');
  return topic.name.substr(slash == std::string::npos ? 0 : slash + 1) == kStaticTopic &&
         (is_type(topic, "tf2_msgs/TFMessage") || is_type(topic, "tf/tfMessage"));
}

// A reading and the frame of its sensor.
struct Measured {
  MessageHeader header;
  std::string sensor_frame;
  decltype(SensorReading::value) value;
};

std::optional<Measured> odometry_of(std::string_view bytes, Serialization serialization,
                                    const std::string& where) {
  const OdometryMessage m = decode_odometry(bytes, serialization, where);
  if (!m.pose.is_finite()) return std::nullopt;
  return Measured{m.header, m.child_frame, OdometryReading{m.pose, m.linear, m.angular}};
}

std::optional<Measured> fix_of(std::string_view bytes, Serialization serialization,
                               const std::string& where) {
  const NavSatFixMessage m = decode_nav_sat_fix(bytes, serialization, where);
  if (!m.has_fix || !earth_centred(m.latitude_deg, m.longitude_deg, m.altitude_m).allFinite())
    return std::nullopt;
  return Measured{m.header, m.header.frame, GpsReading{m.latitude_deg, m.longitude_deg, m.altitude_m}};
}

std::optional<Measured> imu_of(std::string_view bytes, Serialization serialization,
                               const std::string& where) {
  const ImuMessage m = decode_imu(bytes, serialization, where);
  if (!m.angular_velocity.allFinite() || !m.acceleration.allFinite()) return std::nullopt;
  ImuReading reading{std::nullopt, m.angular_velocity, m.acceleration};
  const Eigen::Vector4d& q = m.orientation_xyzw;
  if (q.allFinite() && q.norm() > 0.5)
    reading.R_world_imu = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized();
  return Measured{m.header, m.header.frame, reading};
}

std::optional<Measured> pose_of(std::string_view bytes, Serialization serialization,
                                const std::string& where) {
  const PoseMessage m = decode_pose(bytes, serialization, where);
  if (!m.pose.is_finite()) return std::nullopt;
  return Measured{m.header, "", PoseReading{m.pose}};
}

using Decode = std::optional<Measured> (*)(std::string_view, Serialization, const std::string&);

const std::map<std::string, Decode>& decoders() {
  static const std::map<std::string, Decode> kDecoders{{"nav_msgs/Odometry", odometry_of},
                                                       {"sensor_msgs/NavSatFix", fix_of},
                                                       {"sensor_msgs/Imu", imu_of},
                                                       {"geometry_msgs/PoseStamped", pose_of},
                                                       {"geometry_msgs/PoseWithCovarianceStamped", pose_of}};
  return kDecoders;
}

bool is_sensor(const RecordedTopic& topic) {
  return decoders().count(topic.type) > 0 && topic.serialization != Serialization::kOther;
}

class SensorReader {
 public:
  explicit SensorReader(const SensorContext& context)
      : context_(context), clock_(context.image_times), recording_(open_recording(context.path)) {
    constexpr size_t kMaxBytes = 4096;  // an odometry message has 700
    MessageSelection selection;
    selection.head_bytes = kMaxBytes;
    const auto& topics = recording_->topics();
    for (size_t i = 0; i < topics.size(); ++i) {
      const bool is_image = topics[i].name == context_.image_topic;
      if (is_image || is_sensor(topics[i])) selection.topics.push_back(i);
    }
    recording_->select(selection);
  }

  std::optional<SensorReading> next() {
    while (true) try {
        const auto message = recording_->next();
        if (!message) return std::nullopt;
        if (auto reading = read(*message)) return reading;
      } catch (const InputError&) {  // the reader of the images meets the same damage and reports it
      }
  }

 private:
  std::optional<SensorReading> read(const RecordedMessage& message) {
    const RecordedTopic& topic = recording_->topics()[message.topic];
    const auto decode = decoders().find(topic.type);
    if (decode == decoders().end()) {
      clock_.pass(decode_header(message.bytes, topic.serialization, topic.name).stamp);
      return std::nullopt;
    }
    auto measured = decode->second(message.bytes, topic.serialization, topic.name);
    if (!measured) return std::nullopt;
    const bool has_stamp = measured->header.stamp != Timestamp();
    const Timestamp time =
        has_stamp ? measured->header.stamp : Timestamp::from_nanoseconds(message.recorded_ns);
    const auto place = context_.frames.between(context_.vehicle, measured->sensor_frame);
    return SensorReading{clock_.correct(time), topic.name, place.value_or(SE3()), std::move(measured->value)};
  }

  SensorContext context_;
  ImageClock clock_;
  std::unique_ptr<Recording> recording_;
};

std::optional<Eigen::Vector3d> position_of(const SensorReading& reading, VehicleSensor sensor) {
  if (const auto* o = std::get_if<OdometryReading>(&reading.value); o && sensor == VehicleSensor::kOdometry)
    return o->T_odom_vehicle.translation();
  if (const auto* p = std::get_if<PoseReading>(&reading.value); p && sensor == VehicleSensor::kRobotPose)
    return p->T_map_vehicle.translation();
  if (const auto* g = std::get_if<GpsReading>(&reading.value); g && sensor == VehicleSensor::kGps)
    return earth_centred(g->latitude_deg, g->longitude_deg, g->height_m);
  return std::nullopt;
}

}  // namespace

StaticFrames read_static_frames(Recording* recording) {
  constexpr uint64_t kSearchBytes = 64 << 20;  // of a file without an index
  constexpr int kMaxMessages = 10000;
  MessageSelection selection;
  selection.search_bytes = kSearchBytes;
  for (size_t i = 0; i < recording->topics().size(); ++i)
    if (is_static(recording->topics()[i])) selection.topics.push_back(i);
  StaticFrames frames;
  if (selection.topics.empty()) return frames;
  recording->select(selection);
  for (int i = 0; i < kMaxMessages; ++i) try {
      const auto message = recording->next();
      if (!message) break;
      const RecordedTopic& topic = recording->topics()[message->topic];
      for (const TransformMessage& t : decode_transforms(message->bytes, topic.serialization, topic.name))
        frames.add(t);
    } catch (const InputError&) {  // a damaged one is skipped
    }
  return frames;
}

bool has_sensors(const Recording& recording) {
  return std::any_of(recording.topics().begin(), recording.topics().end(), is_sensor);
}

SensorReadings read_sensors(const SensorContext& context) {
  return [reader = std::make_shared<SensorReader>(context)] { return reader->next(); };
}

VehicleTrack read_recorded_track(const SensorContext& context, VehicleSensor sensor) {
  SensorReader reader(context);
  std::map<std::string, VehicleTrack> tracks;  // by topic
  while (const auto reading = reader.next()) {
    const auto position = position_of(*reading, sensor);
    if (!position) continue;
    VehicleTrack& track = tracks[reading->label];
    track.sensor_on_vehicle = reading->T_vehicle_sensor.translation();
    track.positions.push_back({reading->time, *position});
  }
  return longest_track(std::move(tracks));
}

}  // namespace edgevo
