// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/edge_ply.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "edge_ply_format.h"
#include "edgevo/core/depth_source.h"
#include "edgevo/core/formatted.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

// Appends values in little-endian order on any machine.
void put(std::string* bytes, uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes->push_back(char((value >> shift) & 0xff));
}
void put(std::string* bytes, double value) {
  const float single = float(value);
  uint32_t bits = 0;
  std::memcpy(&bits, &single, sizeof bits);
  put(bytes, bits);
}

// Properties of a vertex besides position and depth.
struct VertexNotes {
  int keyframe = 0, observations = 0, line = -1;
  uint8_t gray = 0, gray_dark = 0, gray_bright = 0, line_kind = 0, views = 0;
};

void put_vertex(const Eigen::Vector3d& p_map, float idepth, float idepth_sigma, const VertexNotes& notes,
                std::string* bytes) {
  for (int i = 0; i < 3; ++i) put(bytes, p_map[i]);
  bytes->append(3, char(notes.gray));
  put(bytes, double(idepth));
  put(bytes, double(idepth_sigma));
  put(bytes, uint32_t(notes.keyframe));
  put(bytes, uint32_t(notes.observations));
  put(bytes, uint32_t(notes.line));
  bytes->push_back(char(notes.gray_dark));
  bytes->push_back(char(notes.gray_bright));
  bytes->push_back(char(notes.line_kind));
  bytes->push_back(char(notes.views));
}

// The body of the file as written so far.
struct Body {
  std::string vertices, edges;
  int vertex_count = 0, edge_count = 0, line_count = 0, point_count = 0;
};

void put_points(const Run& run, const PointFilter& filter, size_t k, const SE3& T_map_cam, Body* body) {
  for (const EdgePoint& p : run.keyframes[k].points) {
    if (!filter.keeps(p)) continue;
    const Eigen::Vector3d p_map = T_map_cam * point_in_camera(run.pinhole, p);
    put_vertex(p_map, p.idepth, p.idepth_sigma, {int(k), p.observations, -1, p.gray, p.gray, p.gray, 0, 0},
               &body->vertices);
    ++body->vertex_count, ++body->point_count;
  }
}

void put_line(const Run& run, const EdgeLine& line, size_t k, const SE3& T_map_cam, Body* body) {
  const uint8_t kind =
      uint8_t((line.is_straight ? ply::kStraight : 0) | (line.is_outline ? ply::kOutline : 0) |
              (line.source == DepthSource::kPlane ? ply::kOnPlane : 0));
  const uint8_t views = uint8_t(std::min(line.views, 255));
  for (size_t i = 0; i < line.vertices.size(); ++i) {
    const EdgeVertex& v = line.vertices[i];
    const uint8_t gray = uint8_t((v.gray_dark + v.gray_bright) / 2);
    put_vertex(T_map_cam * point_in_camera(run.pinhole, v), v.idepth, v.idepth_sigma,
               {int(k), line.keyframes, body->line_count, gray, v.gray_dark, v.gray_bright, kind, views},
               &body->vertices);
    if (i > 0) {
      put(&body->edges, uint32_t(body->vertex_count - 1));
      put(&body->edges, uint32_t(body->vertex_count));
      ++body->edge_count;
    }
    ++body->vertex_count;
  }
  ++body->line_count;
}

std::string pose_text(const SE3& T) {
  std::string text;
  for (int i = 0; i < 3; ++i) append_fixed(&(text += ' '), T.translation()[i], 9);
  for (int i = 0; i < 4; ++i) append_fixed(&(text += ' '), T.rotation().coeffs()[i], 9);
  return text;
}

std::string comment(const char* key, const std::string& value) {
  return std::string("comment ") + key + value + "\n";
}

// Comments from which edge_ply_reader.h rebuilds the map.
std::string run_comments(const Run& run) {
  std::string text = comment(ply::kScale, " " + run.scale_source + " " + fixed(run.scale.factor, 9) + " " +
                                              fixed(run.scale.sigma, 9));
  const Pinhole& c = run.pinhole;
  text += comment(ply::kPinhole,
                  formatted(" %.9g %.9g %.9g %.9g %d %d", c.fx, c.fy, c.cx, c.cy, c.width, c.height));
  if (run.T_vehicle_cam) text += comment(ply::kMount, pose_text(*run.T_vehicle_cam));
  for (const KeyframeRecord& k : run.keyframes) {
    const SE3 T_map_cam = T_map_world(run) * k.T_world_cam;
    text += comment(ply::kKeyframe, " " + std::to_string(k.frame_index) + " " + std::to_string(k.segment) +
                                        pose_text(T_map_cam.is_finite() ? T_map_cam : SE3()));
  }
  return text;
}

std::string header(const Run& run, const Body& body) {
  return "ply\nformat binary_little_endian 1.0\n"
         "comment edge points and lines of edgevo\n"
         "comment unit: " +
         unit_statement(run) +
         "\n"
         "comment axes: x forward, y left, z up; origin at the first " +
         (run.T_vehicle_cam && run.is_metric() ? "vehicle" : "camera") +
         " pose\n"
         "comment idepth: inverse depth in the host keyframe, idepth_sigma: its standard deviation\n" +
         run_comments(run) + "element vertex " + std::to_string(body.vertex_count) +
         "\n"
         "property float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
         "property float idepth\nproperty float idepth_sigma\n"
         "property int keyframe\nproperty int observations\nproperty int line\n"
         "property uchar gray_dark\nproperty uchar gray_bright\nproperty uchar line_kind\nproperty uchar "
         "views\n"
         "element edge " +
         std::to_string(body.edge_count) + "\nproperty int vertex1\nproperty int vertex2\nend_header\n";
}

}  // namespace

int write_edge_ply(const Run& run, const PointFilter& filter, const std::string& path) {
  const SE3 T_map = T_map_world(run);
  Body body;
  for (size_t k = 0; k < run.keyframes.size(); ++k)
    if (const SE3 T_map_cam = T_map * run.keyframes[k].T_world_cam; T_map_cam.is_finite())
      put_points(run, filter, k, T_map_cam, &body);
  for (size_t k = 0; k < run.keyframes.size(); ++k)
    if (const SE3 T_map_cam = T_map * run.keyframes[k].T_world_cam; T_map_cam.is_finite())
      for (const EdgeLine& line : run.keyframes[k].lines) put_line(run, line, k, T_map_cam, &body);
  OutputFile out(path);
  out.write(header(run, body));
  out.write(body.vertices);
  out.write(body.edges);
  out.close();
  return body.point_count;
}

}  // namespace edgevo
