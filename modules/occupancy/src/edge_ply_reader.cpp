// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/edge_ply_reader.h"

#include <cmath>
#include <cstring>
#include <sstream>
#include <utility>

#include "edge_ply_format.h"
#include "edgevo/core/depth_source.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"

namespace edgevo {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw InputError(path, what, "run the sequence again with this version of edgevo");
}

uint32_t little_endian(const char* bytes) {
  uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = (value << 8) | uint8_t(bytes[i]);
  return value;
}
float real(const char* bytes) {
  const uint32_t bits = little_endian(bytes);
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

bool read_pose(std::istream& in, SE3* T) {
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
  if (!(in >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w()) || !(q.norm() > 0.5)) return false;
  *T = SE3(q, t);
  return T->is_finite();
}

// The parsed header. Poses are kept in the map frame at first: their world depends on unit and mount, which
// may come later.
struct Header {
  Run run;
  std::vector<SE3> T_map_cam;
  size_t vertices = 0, edges = 0, end = 0;
  int line = -1;  // index of the last vertex's line
  bool is_ours = false, has_lines = false;
};

bool is_pinhole(const Pinhole& c) { return c.fx > 0 && c.fy > 0 && c.width > 0 && c.height > 0; }

void read_line(const std::string& path, const std::string& line, Header* header) {
  std::istringstream in(line);
  std::string word, key;
  in >> word >> key;
  if (word == "property" && line == "property uchar views") header->has_lines = true;
  if (word == "element" && key == "vertex" && !(in >> header->vertices))
    refuse(path, "its header does not give the number of points");
  if (word == "element" && key == "edge" && !(in >> header->edges))
    refuse(path, "its header does not give the number of edges");
  if (word != "comment") return;
  bool readable = true;
  if (key == ply::kKeyframe) {
    KeyframeRecord keyframe;
    SE3 T_map_cam;
    readable = bool(in >> keyframe.frame_index >> keyframe.segment) && read_pose(in, &T_map_cam);
    header->run.keyframes.push_back(keyframe);
    header->T_map_cam.push_back(T_map_cam);
  } else if (key == ply::kMount) {
    SE3 T_vehicle_cam;
    readable = read_pose(in, &T_vehicle_cam);
    header->run.T_vehicle_cam = T_vehicle_cam;
  } else if (key == ply::kScale) {
    readable = bool(in >> header->run.scale_source >> header->run.scale.factor >> header->run.scale.sigma);
    header->is_ours = true;
  } else if (key == ply::kPinhole) {
    Pinhole& c = header->run.pinhole;
    readable = bool(in >> c.fx >> c.fy >> c.cx >> c.cy >> c.width >> c.height) && is_pinhole(c);
  }
  if (!readable) refuse(path, "'" + line.substr(0, 80) + "' in its header is not readable");
}

Header read_header(const std::string& path, const std::string& bytes) {
  Header header;
  header.run.pinhole = {1, 1, 0, 0, 1, 1};  // of a file that does not say: pixels are rays
  if (bytes.rfind("ply\nformat binary_little_endian 1.0\n", 0) != 0)
    refuse(path, "is not a PLY file of edgevo");
  const size_t end = bytes.find("end_header\n");
  if (end == std::string::npos) refuse(path, "its header does not end");
  std::istringstream lines(bytes.substr(0, end));
  for (std::string line; std::getline(lines, line);) read_line(path, line, &header);
  if (!header.is_ours) refuse(path, "its header gives neither scale nor keyframes");
  if (!header.has_lines) refuse(path, "was written by an older version, which did not know what sees a line");
  header.end = end + std::strlen("end_header\n");
  const size_t body = bytes.size() - header.end;
  if (body / ply::kVertexBytes < header.vertices ||
      (body - header.vertices * ply::kVertexBytes) / ply::kEdgeBytes < header.edges)
    refuse(path, "is truncated: its header announces " + std::to_string(header.vertices) + " points");
  return header;
}

// Adds a vertex; the vertices of a line are consecutive. `notes`: gray_dark, gray_bright, line_kind, views.
void add_to_line(int number, const EdgePoint& p, const uint8_t* notes, Header* header, KeyframeRecord* host) {
  if (std::exchange(header->line, number) != number) {
    EdgeLine line;
    line.keyframes = p.observations;
    line.views = notes[3];
    line.source = notes[2] & ply::kOnPlane ? DepthSource::kPlane : DepthSource::kViews;
    line.is_straight = notes[2] & ply::kStraight;
    line.is_outline = notes[2] & ply::kOutline;
    host->lines.push_back(line);
  }
  host->lines.back().vertices.push_back({p.px, p.idepth, p.idepth_sigma, notes[0], notes[1]});
}

void read_vertex(const std::string& path, const char* bytes, Header* header) {
  const Eigen::Vector3d p_map(real(bytes), real(bytes + 4), real(bytes + 8));
  const size_t keyframe = little_endian(bytes + ply::kKeyframeOffset);
  if (keyframe >= header->T_map_cam.size()) refuse(path, "a point's keyframe is not in the header");
  const Eigen::Vector3d p_cam = header->T_map_cam[keyframe].inverse() * p_map;
  if (!p_cam.allFinite() || !(p_cam.z() > 0)) refuse(path, "a point lies behind its keyframe");
  EdgePoint point;
  point.px = header->run.pinhole.project(p_cam).cast<float>();
  point.normal = {1, 0};
  point.gray = uint8_t(bytes[12]);
  point.idepth = float(1 / p_cam.z());
  point.idepth_sigma =
      real(bytes + ply::kIdepthOffset + 4) * (point.idepth / real(bytes + ply::kIdepthOffset));
  point.observations = int(little_endian(bytes + ply::kKeyframeOffset + 4));
  KeyframeRecord& host = header->run.keyframes[keyframe];
  if (const int line = int(little_endian(bytes + ply::kLineOffset)); line >= 0)
    add_to_line(line, point, reinterpret_cast<const uint8_t*>(bytes + ply::kSidesOffset), header, &host);
  else
    host.points.push_back(point);
}

}  // namespace

Run read_edge_ply(const std::string& path) {
  const std::string bytes = read_file(path, "give the folder of a finished `edgevo run`");
  Header header = read_header(path, bytes);
  for (size_t i = 0; i < header.vertices; ++i)
    read_vertex(path, bytes.data() + header.end + i * ply::kVertexBytes, &header);
  Run run = std::move(header.run);
  const SE3 T_world_map = T_map_world(run).inverse();
  for (size_t k = 0; k < run.keyframes.size(); ++k)
    run.keyframes[k].T_world_cam = T_world_map * header.T_map_cam[k];
  return run;
}

}  // namespace edgevo
