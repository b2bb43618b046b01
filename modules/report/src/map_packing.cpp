// SPDX-License-Identifier: BSD-3-Clause
#include "map_packing.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base64.h"
#include "color_ramp.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

// Vertices with a common box; the boxes add 2 % to the size.
constexpr size_t kBlock = 1024;
// Vertices of a line that are kept or dropped together.
constexpr size_t kLongestPiece = 256;

// Collects values as little-endian bytes, on any machine.
class Bytes {
 public:
  void u8(uint8_t v) { bytes_.push_back(v); }
  void u16(unsigned v) { u8(uint8_t(v)), u8(uint8_t(v >> 8)); }
  void u32(uint32_t v) { u16(v & 0xffff), u16(v >> 16); }
  void f32(double v) {
    const float f = float(v);
    uint32_t bits;
    std::memcpy(&bits, &f, sizeof bits);
    u32(bits);
  }
  void vector(const Eigen::Vector3d& v) { f32(v.x()), f32(v.y()), f32(v.z()); }
  std::string text() const { return base64(bytes_); }

 private:
  std::vector<uint8_t> bytes_;
};

size_t end_of_piece(const std::vector<MapVertex>& vertices, size_t begin) {
  size_t end = begin + 1;
  while (end < vertices.size() && end - begin < kLongestPiece && vertices[end].joined) ++end;
  return end;
}

struct Box {
  Eigen::Array3f low, step;
};

Box box_of(const MapVertex* begin, const MapVertex* end) {
  Eigen::Array3f low = begin->position.array(), high = low;
  for (const MapVertex* v = begin; v != end; ++v)
    low = low.min(v->position.array()), high = high.max(v->position.array());
  return {low, (high - low) / 65535.0f};
}

unsigned steps_of(float value, float low, float step) {
  return step > 0 ? unsigned(std::clamp(std::lround((value - low) / step), 0l, 65535l)) : 0;
}

void pack_block(const MapVertex* begin, const MapVertex* end, Bytes* boxes, Bytes* positions) {
  const Box box = box_of(begin, end);
  for (const Eigen::Array3f& corner : {box.low, box.step})
    for (int i = 0; i < 3; ++i) boxes->f32(corner[i]);
  for (const MapVertex* v = begin; v != end; ++v)
    for (int i = 0; i < 3; ++i) positions->u16(steps_of(v->position[i], box.low[i], box.step[i]));
}

std::string entry(const std::string& name, const std::string& value) {
  return "\"" + name + "\":\"" + value + "\",\n";
}
std::string entry(const std::string& name, double value) {
  return "\"" + name + "\":" + fixed(value, 9) + ",\n";
}

std::string packed_positions(const std::vector<MapVertex>& vertices) {
  Bytes boxes, positions;
  for (size_t i = 0; i < vertices.size(); i += kBlock)
    pack_block(&vertices[i], vertices.data() + std::min(i + kBlock, vertices.size()), &boxes, &positions);
  return entry("block", double(kBlock)) + entry("boxes", boxes.text()) + entry("positions", positions.text());
}

std::string packed_sigmas(const std::vector<MapVertex>& vertices) {
  float low = std::numeric_limits<float>::infinity(), high = 0;
  for (const MapVertex& v : vertices)
    if (v.sigma > 0) low = std::min(low, v.sigma), high = std::max(high, v.sigma);
  Bytes sigmas;
  const double octaves = std::log2(high / low);
  for (const MapVertex& v : vertices) {
    const double share = v.sigma > 0 && octaves > 0 ? std::log2(v.sigma / low) / octaves : 0;
    sigmas.u8(v.sigma > 0 ? uint8_t(1 + std::lround(254 * share)) : 0);
  }
  return entry("sigma_low", high > 0 ? low : 0) + entry("sigma_high", high) + entry("sigma", sigmas.text());
}

std::string packed_grays(const std::vector<MapVertex>& vertices) {
  Bytes grays;
  for (const MapVertex& v : vertices) grays.u8(v.gray);
  return entry("gray", grays.text());
}

std::string packed_joints(const std::vector<MapVertex>& vertices) {
  if (std::none_of(vertices.begin(), vertices.end(), [](const MapVertex& v) { return v.joined; }))
    return entry("joined", "");
  Bytes bits;
  for (size_t i = 0; i < vertices.size(); i += 8) {
    unsigned eight = 0;
    for (size_t k = i; k < std::min(i + 8, vertices.size()); ++k)
      eight |= unsigned(vertices[k].joined) << (k - i);
    bits.u8(uint8_t(eight));
  }
  return entry("joined", bits.text());
}

std::string packed_hosts(const std::vector<MapVertex>& vertices) {
  Bytes hosts;
  for (size_t begin = 0; begin < vertices.size();) {
    size_t end = begin + 1;
    while (end < vertices.size() && vertices[end].keyframe == vertices[begin].keyframe) ++end;
    hosts.u32(uint32_t(end - begin)), hosts.u32(uint32_t(vertices[begin].keyframe));
    begin = end;
  }
  return entry("hosts", hosts.text());
}

std::string packed_path(const std::string& name, const std::vector<std::optional<Eigen::Vector3d>>& path) {
  Bytes positions;
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  for (const auto& p : path) positions.vector(p.value_or(none));
  return entry(name, positions.text());
}

std::string packed_seconds(const std::vector<double>& seconds) {
  Bytes values;
  for (const double s : seconds) values.f32(s);
  return entry("seconds", values.text());
}

std::string packed_keyframes(const std::vector<MapKeyframe>& keyframes) {
  Bytes poses, frames;
  for (const MapKeyframe& k : keyframes) {
    poses.vector(k.T_map_cam.translation());
    for (int i = 0; i < 4; ++i) poses.f32(k.T_map_cam.rotation().coeffs()[i]);
    frames.u32(uint32_t(k.frame_index));
  }
  return entry("keyframes", poses.text()) + entry("frames", frames.text());
}

std::string packed_ramp() {
  Bytes rgb;
  for (const auto& color : color_ramp())
    for (const uint8_t c : color) rgb.u8(c);
  return rgb.text();
}

}  // namespace

std::vector<MapVertex> thinned(const std::vector<MapVertex>& vertices, size_t most) {
  if (vertices.size() <= most) return vertices;
  std::vector<MapVertex> kept;
  const double share = double(most) / double(vertices.size());
  double due = 0;  // number of vertices that may be kept so far
  for (size_t begin = 0; begin < vertices.size();) {
    const size_t end = end_of_piece(vertices, begin);
    due += share * double(end - begin);
    if (double(kept.size() + end - begin) <= due) {
      kept.insert(kept.end(), vertices.begin() + std::ptrdiff_t(begin),
                  vertices.begin() + std::ptrdiff_t(end));
      kept[kept.size() - (end - begin)].joined = false;  // the piece before may have been dropped
    }
    begin = end;
  }
  return kept;
}

std::string packed(const MapView& view) {
  const std::vector<MapVertex>& v = view.vertices;
  return "{" + entry("unit", view.unit) + packed_positions(v) + packed_sigmas(v) + packed_grays(v) +
         packed_joints(v) + packed_hosts(v) + packed_path("path", view.path) +
         packed_path("truth", view.truth) + packed_seconds(view.seconds) + packed_keyframes(view.keyframes) +
         "\"ramp\":\"" + packed_ramp() + "\"}";
}

}  // namespace edgevo
