// SPDX-License-Identifier: BSD-3-Clause
// write_recording SOURCE KIND ENCODING OUT [TRUTH.txt]: any source as a recording of ROS, for tests. KIND:
// bag, bag-bz2, bag-lz4, mcap, mcap-zstd, mcap-lz4, mcap-open (its recorder was killed), db3 (a folder),
// db3-zstd. ENCODING: mono8, rgb8, bgr8, rgba8, bgra8, yuv422, yuv422_yuy2, file (CompressedImage with the
// files of the images). With the ground truth of the camera (TUM) also odometry, satellite fixes and poses
// made from it. Stamps are those of the source; the recorder is 3 ms late. The vehicle is in the camera,
// which looks forward.
#include <cmath>
#include <cstdio>
#include <map>

#include "edgevo/core/error.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/evaluation/trajectory.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "support/recording_files.h"
#include "support/recording_messages.h"
#include "support/text.h"

namespace {

using namespace edgevo;
using namespace edgevo::test;

enum Topic { kTf, kInfo, kImage, kOdometry, kFix, kPose };

int64_t ns_of(Timestamp t) { return t.ticks * 100; }

// Gray as bytes of an encoding.
std::string encoded(const GrayImage& image, const std::string& encoding, uint32_t* step) {
  const bool is_yuv = encoding.rfind("yuv", 0) == 0;
  const size_t bytes = encoding == "mono8" ? 1 : is_yuv ? 2 : encoding.size() - 1;
  std::string data(image.pixels.size() * bytes, char(128));
  for (size_t i = 0; i < image.pixels.size(); ++i)
    for (size_t k = 0; k < bytes; ++k)
      if (!is_yuv || k == (encoding == "yuv422" ? 1u : 0u)) data[i * bytes + k] = char(image.pixels[i]);
  *step = uint32_t(bytes) * uint32_t(image.width);
  return data;
}

class RecordingMaker {
 public:
  RecordingMaker(Wire wire, const std::string& encoding) : wire_(wire), encoding_(encoding) {}

  void add_static() {
    add(kTf, 0,
        transforms_message(wire_, {{"base_link", "cam0_optical", {0, 0, 0}, {0.5, -0.5, 0.5, -0.5}}}));
  }
  void add(const Frame& frame, const Camera& camera) {
    const int64_t ns = ns_of(frame.time);
    add_info(ns, camera);
    if (encoding_ == "file") {
      const bool is_png = frame.image_path.find(".png") != std::string::npos;
      add(kImage, ns, compressed_message(wire_, ns, is_png ? "png" : "jpeg", content(frame.image_path)));
      return;
    }
    TestImage image{frame.image.width, frame.image.height, encoding_, {}, 0};
    image.data = encoded(frame.image, encoding_, &image.step);
    add(kImage, ns, image_message(wire_, ns, image));
  }
  void add_sensors(Timestamp time, const SE3& T_map_vehicle) {
    constexpr double kLatitude = 43.0, kMeridian = 6365000.0,
                     kParallel = 4672600.0;  // degrees; radii there, metres
    const Eigen::Vector3d& p = T_map_vehicle.translation();
    const Eigen::Vector4d q = T_map_vehicle.rotation().coeffs();
    const std::vector<double> position{p.x(), p.y(), p.z()}, xyzw{q[0], q[1], q[2], q[3]};
    const int64_t ns = ns_of(time);
    add(kOdometry, ns, odometry_message(wire_, ns, position, xyzw));
    add(kPose, ns, pose_message(wire_, ns, position, xyzw));
    add(kFix, ns,
        nav_sat_fix_message(
            wire_, ns, 0,
            {kLatitude + p.y() / kMeridian * 180 / M_PI, 6.0 + p.x() / kParallel * 180 / M_PI, 150 + p.z()}));
  }
  std::vector<TestTopic> topics() const {
    return {{"/tf_static", "tf2_msgs/TFMessage"},
            {"/cam0/camera_info", "sensor_msgs/CameraInfo"},
            {encoding_ == "file" ? "/cam0/image_raw/compressed" : "/cam0/image_raw",
             encoding_ == "file" ? "sensor_msgs/CompressedImage" : "sensor_msgs/Image"},
            {"/odom", "nav_msgs/Odometry"},
            {"/fix", "sensor_msgs/NavSatFix"},
            {"/pose", "geometry_msgs/PoseStamped"}};
  }
  const std::vector<TestMessage>& messages() const { return messages_; }

 private:
  void add(Topic topic, int64_t ns, std::string bytes) {
    constexpr int64_t kLate = 3'000'000;  // ns
    messages_.push_back({size_t(topic), ns + kLate, std::move(bytes)});
  }
  void add_info(int64_t ns, const Camera& camera) {
    const Pinhole p = camera.pinhole();
    const Distortion d = camera.distortion();
    TestCameraInfo info{p.width, p.height, "plumb_bob", {d.k1, d.k2, d.p1, d.p2, d.k3}};
    info.K = {p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1};
    add(kInfo, ns, camera_info_message(wire_, ns, info));
  }

  Wire wire_;
  std::string encoding_;
  std::vector<TestMessage> messages_;
};

void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void write(const RecordingMaker& maker, const std::string& kind, const std::string& out) {
  constexpr size_t kChunkBytes = 786432;
  const std::string compression = kind.find('-') == std::string::npos ? "" : kind.substr(kind.find('-') + 1);
  if (kind.rfind("bag", 0) == 0)
    return write_file(out, ros1_bag(maker.topics(), maker.messages(),
                                    compression.empty() ? "none" : compression, kChunkBytes));
  if (kind.rfind("mcap", 0) == 0) {
    McapOptions options;
    options.is_closed = compression != "open";
    options.compression = options.is_closed ? compression : "zstd";
    options.chunk_bytes = kChunkBytes;
    return write_file(out, mcap_file(maker.topics(), maker.messages(), options));
  }
  std::filesystem::create_directories(out);
  write_db3(out + "/x_0.db3", maker.topics(), maker.messages(), compression);
  write_file(out + "/metadata.yaml", ros2_metadata({"x_0.db3"}, maker.topics(), maker.messages(), "sqlite3",
                                                   compression.empty() ? "" : "MESSAGE"));
}

std::map<int64_t, SE3> true_poses(const std::string& path) {
  std::map<int64_t, SE3> poses;
  for (const StampedPose& pose : read_trajectory(path).poses) poses[pose.time.ticks] = pose.T_world_cam;
  return poses;
}

}  // namespace

int main(int count, char** arguments) try {
  if (count < 5) throw InputError(arguments[0], "needs SOURCE KIND ENCODING OUT [TRUTH.txt]", "");
  const std::string kind = arguments[2];
  RecordingMaker maker(kind.rfind("bag", 0) == 0 ? Wire::kRos1 : Wire::kCdrLittle, arguments[3]);
  const std::map<int64_t, SE3> truth = count > 5 ? true_poses(arguments[5]) : std::map<int64_t, SE3>();
  maker.add_static();
  const auto source = open_source(arguments[1]);
  while (const auto frame = source->next()) {
    maker.add(*frame, source->camera());
    const auto pose = truth.find(frame->time.ticks);
    if (pose == truth.end()) continue;
    maker.add_sensors(frame->time,
                      T_vehicle_cam_forward() * pose->second * T_vehicle_cam_forward().inverse());
  }
  write(maker, kind, arguments[4]);
} catch (const InputError& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}
