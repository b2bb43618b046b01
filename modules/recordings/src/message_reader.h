// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fields of a message, one after the other, as ROS 1 or CDR lay them out.
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "edgevo/recordings/messages.h"

namespace edgevo {

/// Reads fields. Throws InputError, opened by `where`, where the message ends before a field does.
class MessageReader {
 public:
  /// CDR: reads the head of four bytes, which states the byte order.
  MessageReader(std::string_view bytes, Serialization serialization, const std::string& where);

  /// Whether the layout is that of ROS 1.
  bool is_ros1() const { return !is_cdr_; }
  /// A number. CDR: aligned to its size.
  template <class T>
  T number() {
    char raw[sizeof(T)];
    align(sizeof(T));
    const std::string_view taken = take(sizeof(T));
    for (size_t i = 0; i < sizeof(T); ++i) raw[i] = taken[is_big_endian_ ? sizeof(T) - 1 - i : i];
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }
  /// A text.
  std::string text();
  /// A list of bytes; points into the message.
  std::string_view bytes();
  /// A list of numbers.
  std::vector<double> numbers();
  /// Numbers of an array of fixed length.
  void fill(double* values, size_t count);
  /// The length of a list whose elements have `min_bytes` at least.
  size_t length(size_t min_bytes);
  /// std_msgs/Header.
  MessageHeader header();
  /// geometry_msgs/Vector3 and Point.
  Eigen::Vector3d vector();
  /// geometry_msgs/Pose and Transform: a point and a quaternion x, y, z, w. Of a quaternion of zeros the
  /// identity.
  SE3 pose();
  /// Throws InputError.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void align(size_t size);
  std::string_view take(size_t length);

  std::string_view bytes_;
  std::string where_;
  size_t at_ = 0, origin_ = 0, largest_alignment_ = 8;
  bool is_cdr_, is_big_endian_ = false;
};

}  // namespace edgevo
