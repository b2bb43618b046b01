// SPDX-License-Identifier: BSD-3-Clause
#include "ros_messages.h"

#include "cdr.h"

namespace edgevo {
namespace {

constexpr int64_t kNanosecondsPerTick = 100;
// Of the lines, unit of the run: a tenth of a thick pen at ten units; and their colour.
constexpr double kLineWidth = 0.02;
constexpr float kLineColour[] = {0.3f, 0.75f, 1, 1};

void add(CdrWriter* out, Timestamp time) {
  int64_t second = time.ticks / Timestamp::kTicksPerSecond, rest = time.ticks % Timestamp::kTicksPerSecond;
  if (rest < 0) --second, rest += Timestamp::kTicksPerSecond;
  out->add(int32_t(second));
  out->add(uint32_t(rest * kNanosecondsPerTick));
}

void add(CdrWriter* out, const RosHeader& header) {
  add(out, header.time);
  out->add(header.frame);
}

void add(CdrWriter* out, const Eigen::Vector3d& v) {
  for (int i = 0; i < 3; ++i) out->add(v[i]);
}

void add(CdrWriter* out, const Eigen::Quaterniond& q) {
  for (const double value : {q.x(), q.y(), q.z(), q.w()}) out->add(value);
}

// A Pose or a Transform.
void add(CdrWriter* out, const SE3& T) {
  add(out, T.translation());
  add(out, T.rotation());
}

// Symmetric to the last bit, and in the digits of a float32, which is more than a covariance is worth: the
// rest are zeros, which compress.
void add(CdrWriter* out, const Matrix6d& covariance) {
  for (int row = 0; row < 6; ++row)
    for (int col = 0; col < 6; ++col)
      out->add(double(float(0.5 * (covariance(row, col) + covariance(col, row)))));
}

void add(CdrWriter* out, const RosPose& pose) {
  add(out, pose.T);
  add(out, pose.covariance);
}

void add(CdrWriter* out, const RosTwist& twist) {
  for (int i = 0; i < 6; ++i) out->add(twist.velocity[i]);
  add(out, twist.covariance);
}

void add_cloud_field(CdrWriter* out, std::string_view name, uint32_t offset) {
  constexpr uint8_t kFloat32 = 7;
  out->add(name);
  out->add(offset);
  out->add(kFloat32);
  out->add(uint32_t(1));
}

// The end of a marker: texture, text, mesh, all empty.
void add_nothing_else(CdrWriter* out) {
  out->add("");  // texture_resource
  add(out, RosHeader());
  out->add("");
  out->begin_sequence(0);
  out->begin_sequence(0);  // uv_coordinates
  out->add("");
  out->add("");
  out->add("");  // mesh_file
  out->begin_sequence(0);
  out->add(false);
}

void add_marker(CdrWriter* out, const RosHeader& header, int action, const RosLines& lines) {
  constexpr int kLineList = 5;
  add(out, header);
  out->add("edges");
  for (const int number : {lines.id, kLineList, action}) out->add(int32_t(number));
  add(out, SE3());
  add(out, Eigen::Vector3d(kLineWidth, 0, 0));
  for (const float part : kLineColour) out->add(part);
  out->add(int32_t(0));  // lifetime: for ever
  out->add(uint32_t(0));
  out->add(false);
  out->begin_sequence(lines.ends.size());
  for (const Eigen::Vector3d& end : lines.ends) add(out, end);
  out->begin_sequence(0);  // colours
  add_nothing_else(out);
}

int8_t ros_value(GridCell cell) {
  switch (cell) {
    case GridCell::kFree:
      return 0;
    case GridCell::kOccupied:
      return 100;
    case GridCell::kUnknown:
      break;
  }
  return -1;
}

}  // namespace

std::string tf_message(const std::vector<RosTransform>& transforms) {
  CdrWriter out;
  out.begin_sequence(transforms.size());
  for (const RosTransform& t : transforms) {
    add(&out, t.header);
    out.add(t.child);
    add(&out, t.T_parent_child);
  }
  return out.take();
}

std::string odometry_message(const RosHeader& header, const std::string& child, const RosPose& pose,
                             const RosTwist& twist) {
  CdrWriter out;
  add(&out, header);
  out.add(child);
  add(&out, pose);
  add(&out, twist);
  return out.take();
}

std::string pose_message(const RosHeader& header, const SE3& pose) {
  CdrWriter out;
  add(&out, header);
  add(&out, pose);
  return out.take();
}

std::string pose_with_covariance_message(const RosHeader& header, const RosPose& pose) {
  CdrWriter out;
  add(&out, header);
  add(&out, pose);
  return out.take();
}

std::string path_message(const RosHeader& header, const std::vector<std::pair<Timestamp, SE3>>& poses) {
  CdrWriter out;
  add(&out, header);
  out.begin_sequence(poses.size());
  for (const auto& [time, pose] : poses) {
    add(&out, RosHeader{time, header.frame});
    add(&out, pose);
  }
  return out.take();
}

std::string cloud_message(const RosHeader& header, const std::vector<RosPoint>& points) {
  constexpr uint32_t kStep = 5 * sizeof(float);
  CdrWriter out;
  add(&out, header);
  out.add(uint32_t(1));
  out.add(uint32_t(points.size()));
  uint32_t offset = 0;
  out.begin_sequence(5);
  for (const char* name : {"x", "y", "z", "intensity", "sigma"}) {
    add_cloud_field(&out, name, offset);
    offset += sizeof(float);
  }
  out.add(false);
  out.add(kStep);
  out.add(uint32_t(kStep * points.size()));
  std::string data;
  for (const RosPoint& p : points)
    for (const float value : {p.position.x(), p.position.y(), p.position.z(), p.intensity, p.sigma})
      data.append(reinterpret_cast<const char*>(&value), sizeof value);
  out.add_bytes(data);
  out.add(true);
  return out.take();
}

std::string lines_message(const RosHeader& header, const std::vector<RosLines>& lines, bool replaces_all) {
  constexpr int kAdd = 0, kDeleteAll = 3;
  CdrWriter out;
  out.begin_sequence(lines.size() + size_t(replaces_all));
  if (replaces_all) add_marker(&out, header, kDeleteAll, {});
  for (const RosLines& l : lines) add_marker(&out, header, kAdd, l);
  return out.take();
}

std::string grid_message(const RosHeader& header, const OccupancyGrid& grid) {
  CdrWriter out;
  add(&out, header);
  add(&out, header.time);
  out.add(float(grid.resolution));
  out.add(uint32_t(grid.width));
  out.add(uint32_t(grid.height));
  add(&out, SE3(Eigen::Quaterniond::Identity(), {grid.origin_x, grid.origin_y, 0}));
  out.begin_sequence(grid.cells.size());
  for (const GridCell cell : grid.cells) out.add(ros_value(cell));
  return out.take();
}

std::string camera_message(const RosHeader& header, const Pinhole& p) {
  CdrWriter out;
  add(&out, header);
  out.add(uint32_t(p.height));
  out.add(uint32_t(p.width));
  out.add("plumb_bob");
  out.begin_sequence(5);
  for (int i = 0; i < 5; ++i) out.add(0.0);
  for (const double k : {p.fx, 0.0, p.cx, 0.0, p.fy, p.cy, 0.0, 0.0, 1.0}) out.add(k);
  for (const double r : {1, 0, 0, 0, 1, 0, 0, 0, 1}) out.add(r);
  for (const double v : {p.fx, 0.0, p.cx, 0.0, 0.0, p.fy, p.cy, 0.0, 0.0, 0.0, 1.0, 0.0}) out.add(v);
  for (int i = 0; i < 6; ++i) out.add(uint32_t(0));  // binning and region of interest: all of it
  out.add(false);
  return out.take();
}

std::string image_message(const RosHeader& header, std::string_view jpeg) {
  CdrWriter out;
  add(&out, header);
  out.add("jpeg");
  out.add_bytes(jpeg);
  return out.take();
}

std::string log_message(Timestamp time, RosLevel level, const std::string& text) {
  CdrWriter out;
  add(&out, time);
  out.add(uint8_t(level));
  out.add("edgevo");
  out.add(text);
  out.add("");  // file and function
  out.add("");
  out.add(uint32_t(0));
  return out.take();
}

std::string bool_message(bool value) {
  CdrWriter out;
  out.add(value);
  return out.take();
}

std::string count_message(uint32_t value) {
  CdrWriter out;
  out.add(value);
  return out.take();
}

}  // namespace edgevo
