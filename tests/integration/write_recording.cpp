// SPDX-License-Identifier: BSD-3-Clause
// write_recording SOURCE KIND ENCODING OUT [TRUTH.txt]: any source as a recording of ROS, for tests. KIND:
// bag, bag-bz2, bag-lz4, mcap, mcap-zstd, mcap-lz4, mcap-open (its recorder was killed), db3-alone (a file);
// folders: db3, db3-zstd (each message), db3-file (the file in zstd), mcap-folder, and images, files of what
// a Bayer pattern or 16 bits show. ENCODING: see support/encoded_pixels.h; file (CompressedImage with the
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
#include "support/encoded_pixels.h"
#include "support/recording_files.h"
#include "support/recording_messages.h"
#include "support/text.h"

namespace {

using namespace edgevo;
using namespace edgevo::test;

constexpr size_t kChunkBytes = 786432;

enum Topic { kTf, kInfo, kImage, kOdometry, kFix, kPose };

int64_t ns_of(Timestamp t) { return t.ticks * 100; }

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
    TestImage image{frame.image.width, frame.image.height, encoding_, encoded(frame.image, encoding_), 0};
    image.step = uint32_t(image.data.size()) / uint32_t(image.height);
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

std::string mcap_bytes(const RecordingMaker& maker, const std::string& compression) {
  McapOptions options;
  options.is_closed = compression != "open";
  options.compression = options.is_closed ? compression : "zstd";
  options.chunk_bytes = kChunkBytes;
  return mcap_file(maker.topics(), maker.messages(), options);
}

// A folder as ROS 2 writes it. MODE: of the compression.
void write_folder(const RecordingMaker& maker, const std::string& storage, const std::string& mode,
                  const std::string& out) {
  std::filesystem::create_directories(out);
  const bool is_mcap = storage == "mcap";
  std::string name = is_mcap ? "x_0.mcap" : "x_0.db3";
  const std::string path = out + "/" + name;
  if (is_mcap)
    write_file(path, mcap_bytes(maker, "zstd"));
  else
    write_db3(path, maker.topics(), maker.messages(), mode == "MESSAGE" ? "zstd" : "");
  if (mode == "FILE") {
    name += ".zstd";
    write_file(out + "/" + name, packed("zstd", content(path)));
    std::filesystem::remove(path);
  }
  write_file(out + "/metadata.yaml", ros2_metadata({name}, maker.topics(), maker.messages(), storage, mode));
}

void write(const RecordingMaker& maker, const std::string& kind, const std::string& out) {
  const std::string compression = kind.find('-') == std::string::npos ? "" : kind.substr(kind.find('-') + 1);
  if (kind.rfind("bag", 0) == 0)
    return write_file(out, ros1_bag(maker.topics(), maker.messages(),
                                    compression.empty() ? "none" : compression, kChunkBytes));
  if (compression == "folder") return write_folder(maker, "mcap", "", out);
  if (kind.rfind("mcap", 0) == 0) return write_file(out, mcap_bytes(maker, compression));
  if (compression == "alone") return write_db3(out, maker.topics(), maker.messages());
  write_folder(maker, "sqlite3",
               compression == "zstd"   ? "MESSAGE"
               : compression == "file" ? "FILE"
                                       : "",
               out);
}

std::string netpbm(const char* type, const GrayImage& image, int largest, const std::string& pixels) {
  return std::string(type) + "\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n" +
         std::to_string(largest) + "\n" + pixels;
}

// A file of what an encoding shows: the colours of a Bayer pattern, else 16 bits.
void write_image(const Frame& frame, const std::string& encoding, const std::string& folder) {
  const GrayImage& image = frame.image;
  const bool is_bayer = encoding.rfind("bayer", 0) == 0;
  char name[16];
  std::snprintf(name, sizeof name, "%06d.%s", frame.index, is_bayer ? "ppm" : "pgm");
  write_file(folder + "/" + name, is_bayer
                                      ? netpbm("P6", image, 255, rgb_of_bayer(image, pattern_of(encoding)))
                                      : netpbm("P5", image, 65535, big_endian(encoded(image, encoding))));
}

std::map<int64_t, SE3> true_poses(const std::string& path) {
  std::map<int64_t, SE3> poses;
  for (const StampedPose& pose : read_trajectory(path).poses) poses[pose.time.ticks] = pose.T_world_cam;
  return poses;
}

}  // namespace

int main(int count, char** arguments) try {
  if (count < 5) throw InputError(arguments[0], "needs SOURCE KIND ENCODING OUT [TRUTH.txt]", "");
  const std::string kind = arguments[2], encoding = arguments[3], out = arguments[4];
  RecordingMaker maker(kind.rfind("bag", 0) == 0 ? Wire::kRos1 : Wire::kCdrLittle, encoding);
  const std::map<int64_t, SE3> truth = count > 5 ? true_poses(arguments[5]) : std::map<int64_t, SE3>();
  maker.add_static();
  const auto source = open_source(arguments[1]);
  while (const auto frame = source->next()) {
    if (kind == "images") {
      write_image(*frame, encoding, out);
      continue;
    }
    maker.add(*frame, source->camera());
    const auto pose = truth.find(frame->time.ticks);
    if (pose == truth.end()) continue;
    maker.add_sensors(frame->time,
                      T_vehicle_cam_forward() * pose->second * T_vehicle_cam_forward().inverse());
  }
  if (kind != "images") write(maker, kind, out);
} catch (const InputError& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}
