#include "edgevo/occupancy/edge_ply.h"

#include <cstdint>
#include <cstring>

#include "edge_ply_format.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

// Little endian whatever the machine is.
void put(std::string* bytes, uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes->push_back(char((value >> shift) & 0xff));
}
void put(std::string* bytes, double value) {
  const float single = float(value);
  uint32_t bits = 0;
  std::memcpy(&bits, &single, sizeof bits);
  put(bytes, bits);
}

void put_vertex(const EdgePoint& p, const Eigen::Vector3d& p_map, int keyframe, std::string* bytes) {
  for (int i = 0; i < 3; ++i) put(bytes, p_map[i]);
  bytes->append(3, char(p.gray));
  put(bytes, double(p.idepth));
  put(bytes, double(p.idepth_sigma));
  put(bytes, uint32_t(keyframe));
  put(bytes, uint32_t(p.observations));
}

std::string pose_text(const SE3& T) {
  std::string text;
  for (int i = 0; i < 3; ++i) append_fixed(&(text += ' '), T.translation()[i], 9);
  for (int i = 0; i < 4; ++i) append_fixed(&(text += ' '), T.rotation().coeffs()[i], 9);
  return text;
}

std::string comment(const char* key, const std::string& value) { return std::string("comment ") + key + value + "\n"; }

// What it takes to build the map again: edge_ply_reader.h.
std::string run_comments(const Run& run) {
  std::string text = comment(ply::kScale, " " + run.scale_source + " " + fixed(run.scale.factor, 9) + " " + fixed(run.scale.sigma, 9));
  if (run.T_vehicle_cam) text += comment(ply::kMount, pose_text(*run.T_vehicle_cam));
  for (const KeyframeRecord& k : run.keyframes) {
    const SE3 T_map_cam = T_map_world(run) * k.T_world_cam;
    text += comment(ply::kKeyframe, " " + std::to_string(k.frame_index) + " " + std::to_string(k.segment) +
                                        pose_text(T_map_cam.is_finite() ? T_map_cam : SE3()));
  }
  return text;
}

std::string header(const Run& run, int vertices) {
  return "ply\nformat binary_little_endian 1.0\n"
         "comment edge points of edgevo\n"
         "comment unit: " +
         unit_statement(run) +
         "\n"
         "comment axes: x forward, y left, z up; origin at the first " +
         (run.T_vehicle_cam && run.is_metric() ? "vehicle" : "camera") +
         " pose\n"
         "comment idepth: inverse depth in the host keyframe, idepth_sigma: its standard deviation\n" +
         run_comments(run) +
         "element vertex " +
         std::to_string(vertices) +
         "\n"
         "property float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
         "property float idepth\nproperty float idepth_sigma\n"
         "property int keyframe\nproperty int observations\nend_header\n";
}

}  // namespace

int write_edge_ply(const Run& run, const PointFilter& filter, const std::string& path) {
  const SE3 T_map = T_map_world(run);
  std::string vertices;
  int count = 0;
  for (size_t k = 0; k < run.keyframes.size(); ++k) {
    const SE3 T_map_cam = T_map * run.keyframes[k].T_world_cam;
    if (!T_map_cam.is_finite()) continue;
    for (const EdgePoint& p : run.keyframes[k].points) {
      if (!filter.keeps(p)) continue;
      put_vertex(p, T_map_cam * point_in_camera(run.pinhole, p), int(k), &vertices);
      ++count;
    }
  }
  OutputFile out(path);
  out.write(header(run, count));
  out.write(vertices);
  out.close();
  return count;
}

}  // namespace edgevo
