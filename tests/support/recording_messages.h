// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Messages of ROS as bytes, written field by field from their definitions; shares nothing with what reads
// them.
#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace edgevo::test {

/// How a message is laid out.
enum class Wire { kRos1, kCdrLittle, kCdrBig };

/// Appends fields.
class MessageWriter {
 public:
  explicit MessageWriter(Wire wire) : wire_(wire) {
    if (wire == Wire::kCdrLittle) bytes_ = std::string("\0\1\0\0", 4);
    if (wire == Wire::kCdrBig) bytes_ = std::string("\0\0\0\0", 4);
  }
  template <class T>
  MessageWriter& number(T value) {
    while (wire_ != Wire::kRos1 && (bytes_.size() - 4) % sizeof(T) != 0) bytes_ += '\0';
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (wire_ == Wire::kCdrBig) std::reverse(raw, raw + sizeof(T));
    bytes_.append(raw, sizeof(T));
    return *this;
  }
  MessageWriter& text(const std::string& text) {
    const bool is_ros1 = wire_ == Wire::kRos1;
    number(uint32_t(text.size() + (is_ros1 ? 0 : 1)));
    bytes_ += text;
    if (!is_ros1) bytes_ += '\0';
    return *this;
  }
  MessageWriter& bytes(const std::string& bytes) {
    number(uint32_t(bytes.size()));
    bytes_ += bytes;
    return *this;
  }
  MessageWriter& numbers(const std::vector<double>& values) {
    for (const double v : values) number(v);
    return *this;
  }
  MessageWriter& header(int64_t stamp_ns, const std::string& frame) {
    if (wire_ == Wire::kRos1) number(uint32_t(7));  // seq
    number(uint32_t(stamp_ns / 1'000'000'000)).number(uint32_t(stamp_ns % 1'000'000'000));
    return text(frame);
  }
  std::string done() const { return bytes_; }

 private:
  Wire wire_;
  std::string bytes_;
};

/// sensor_msgs/Image.
struct TestImage {
  int width = 0, height = 0;
  std::string encoding = "mono8", data;
  uint32_t step = 0;
  bool is_big_endian = false;
  std::string frame = "cam0_optical";
};

inline std::string image_message(Wire wire, int64_t stamp_ns, const TestImage& m) {
  return MessageWriter(wire)
      .header(stamp_ns, m.frame)
      .number(uint32_t(m.height))
      .number(uint32_t(m.width))
      .text(m.encoding)
      .number(uint8_t(m.is_big_endian))
      .number(m.step)
      .bytes(m.data)
      .done();
}

inline std::string compressed_message(Wire wire, int64_t stamp_ns, const std::string& format,
                                      const std::string& file) {
  return MessageWriter(wire).header(stamp_ns, "cam0_optical").text(format).bytes(file).done();
}

/// sensor_msgs/CameraInfo.
struct TestCameraInfo {
  int width = 0, height = 0;
  std::string model = "plumb_bob";
  std::vector<double> D, K = std::vector<double>(9), P = std::vector<double>(12);
  uint32_t binning_x = 0, binning_y = 0, roi_x = 0, roi_y = 0, roi_height = 0, roi_width = 0;
};

inline std::string camera_info_message(Wire wire, int64_t stamp_ns, const TestCameraInfo& m) {
  MessageWriter w(wire);
  w.header(stamp_ns, "cam0_optical").number(uint32_t(m.height)).number(uint32_t(m.width)).text(m.model);
  w.number(uint32_t(m.D.size())).numbers(m.D).numbers(m.K).numbers({1, 0, 0, 0, 1, 0, 0, 0, 1}).numbers(m.P);
  w.number(m.binning_x).number(m.binning_y);
  return w.number(m.roi_x).number(m.roi_y).number(m.roi_height).number(m.roi_width).number(uint8_t(0)).done();
}

inline std::string odometry_message(Wire wire, int64_t stamp_ns, const std::vector<double>& position,
                                    const std::vector<double>& xyzw, const std::string& child = "base_link") {
  MessageWriter w(wire);
  w.header(stamp_ns, "odom")
      .text(child)
      .numbers(position)
      .numbers(xyzw)
      .numbers(std::vector<double>(36, 0.1));
  return w.numbers({1, 2, 3, 4, 5, 6}).numbers(std::vector<double>(36, 0.1)).done();
}

inline std::string nav_sat_fix_message(Wire wire, int64_t stamp_ns, int status,
                                       const std::vector<double>& position) {
  MessageWriter w(wire);
  w.header(stamp_ns, "gps").number(int8_t(status)).number(uint16_t(1)).numbers(position);
  return w.numbers(std::vector<double>(9, 1)).number(uint8_t(2)).done();
}

inline std::string imu_message(Wire wire, int64_t stamp_ns, const std::vector<double>& xyzw) {
  MessageWriter w(wire);
  w.header(stamp_ns, "imu").numbers(xyzw).numbers(std::vector<double>(9, 0.1)).numbers({0.1, 0.2, 0.3});
  return w.numbers(std::vector<double>(9, 0.1))
      .numbers({1, 2, 9.8})
      .numbers(std::vector<double>(9, 0.1))
      .done();
}

inline std::string pose_message(Wire wire, int64_t stamp_ns, const std::vector<double>& position,
                                const std::vector<double>& xyzw) {
  return MessageWriter(wire).header(stamp_ns, "map").numbers(position).numbers(xyzw).done();
}

/// One transform of tf2_msgs/TFMessage.
struct TestTransform {
  std::string parent, child;
  std::vector<double> position, xyzw;
};

inline std::string transforms_message(Wire wire, const std::vector<TestTransform>& transforms) {
  MessageWriter w(wire);
  w.number(uint32_t(transforms.size()));
  for (const TestTransform& t : transforms)
    w.header(0, t.parent).text(t.child).numbers(t.position).numbers(t.xyzw);
  return w.done();
}

}  // namespace edgevo::test
