// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/line_table.h"

#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

constexpr int kDecimals = 4;

void append_numbers(const Eigen::Vector3d& p, std::string* row) {
  for (int i = 0; i < 3; ++i) append_fixed(&(*row += ','), p[i], kDecimals);
}

double length_of(const std::vector<Eigen::Vector3d>& points) {
  double length = 0;
  for (size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

std::string row_of(const Run& run, const EdgeLine& line, const SE3& T_map_cam) {
  std::vector<Eigen::Vector3d> points;
  int dark = 0, bright = 0;
  for (const EdgeVertex& v : line.vertices) {
    points.push_back(T_map_cam * point_in_camera(run.pinhole, v));
    dark += v.gray_dark, bright += v.gray_bright;
  }
  const Eigen::Vector3d span = points.back() - points.front();
  const Eigen::Vector3d direction = span.norm() > 0 ? Eigen::Vector3d(span.normalized()) : span;
  const EdgeVertex& middle = line.vertices[line.vertices.size() / 2];
  const int n = int(points.size());
  std::string row;
  append_numbers(points.front(), &row);
  append_numbers(points.back(), &row);
  append_fixed(&(row += ','), length_of(points), kDecimals);
  append_numbers(direction, &row);
  append_fixed(&(row += ','), double(middle.idepth_sigma) / (double(middle.idepth) * double(middle.idepth)),
               kDecimals);
  for (const int number :
       {n, line.keyframes, int(line.is_straight), int(line.is_outline), dark / n, bright / n})
    row += ',' + std::to_string(number);
  row += ',' + std::to_string(line.views) + ',' + to_string(line.source);
  return row;
}

}  // namespace

std::string line_table_csv(const Run& run) {
  std::string text =
      "line,keyframe,frame,x1,y1,z1,x2,y2,z2,length,dx,dy,dz,sigma,vertices,keyframes,straight,outline,gray_"
      "dark,gray_bright,views,source\n";
  int number = 0;
  for (size_t k = 0; k < run.keyframes.size(); ++k) {
    const KeyframeRecord& keyframe = run.keyframes[k];
    const SE3 T_map_cam = T_map_world(run) * keyframe.T_world_cam;
    if (!T_map_cam.is_finite()) continue;
    for (const EdgeLine& line : keyframe.lines)
      text += std::to_string(number++) + ',' + std::to_string(k) + ',' +
              std::to_string(keyframe.frame_index) + row_of(run, line, T_map_cam) + '\n';
  }
  return text;
}

}  // namespace edgevo
