// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bytes_of_values.h"
#include "keyframe_bytes.h"

namespace edgevo {
namespace {

constexpr double kCornerSteps = 16;
constexpr size_t kMaxCorners = 1 << 16, kMaxEdgePixels = 1 << 22;

uint16_t in_corner_steps(float px) {
  return uint16_t(std::clamp(std::lround(px * kCornerSteps), 0L, 65535L));
}

std::string head_of(const RememberedView& view) {
  std::string head;
  append_value(&head, uint32_t(view.corners.px.size()));
  append_value(&head, uint32_t(view.edges.at.size()));
  append_value(&head, uint32_t(view.edges.begins.size()));
  append_value(&head, view.edges.pinhole);
  append_value(&head, view.signature.bits);
  append_value(&head, view.light);
  return head;
}

std::string bytes_of(const std::vector<CornerDescriptor>& descriptors) {
  std::string bytes;
  for (const CornerDescriptor& d : descriptors) bytes.append(d.begin(), d.end());
  return bytes;
}

std::vector<CornerDescriptor> descriptors_of(const std::string& bytes) {
  std::vector<CornerDescriptor> descriptors(bytes.size() / sizeof(CornerDescriptor));
  for (size_t i = 0; i < descriptors.size(); ++i)
    std::copy_n(bytes.begin() + std::ptrdiff_t(i * sizeof(CornerDescriptor)), sizeof(CornerDescriptor),
                descriptors[i].begin());
  return descriptors;
}

void add_corners(const ViewCorners& corners, PieceWriter* out) {
  std::vector<uint16_t> x, y;
  for (const Eigen::Vector2f& px : corners.px)
    x.push_back(in_corner_steps(px.x())), y.push_back(in_corner_steps(px.y()));
  out->add(x);
  out->add(y);
  out->add(bytes_of(corners.descriptors));
}

ViewCorners read_corners(size_t count, PieceReader* in) {
  ViewCorners corners;
  const std::vector<uint16_t> x = in->next_16(count), y = in->next_16(count);
  corners.descriptors = descriptors_of(in->next());
  for (size_t i = 0; in->ok() && i < count; ++i)
    corners.px.emplace_back(float(x[i] / kCornerSteps), float(y[i] / kCornerSteps));
  return corners;
}

// The next pixel of an edge lies next to the one before, along the edge: where it is expected from the two
// before.
struct ChainPredictor {
  int at[2] = {0, 0}, step[2] = {0, 0};

  int expected(int axis) const { return at[axis] + step[axis]; }
  void note(int x, int y, bool begins) {
    const int next[2] = {x, y};
    for (int axis = 0; axis < 2; ++axis) {
      step[axis] = begins ? 0 : expected_step(next[axis] - at[axis]);
      at[axis] = next[axis];
    }
  }
  static int expected_step(int last) { return last; }
};

std::vector<int> lengths_of(const PackedEdges& edges) {
  std::vector<int> lengths;
  for (size_t c = 0; c < edges.begins.size(); ++c) {
    const int end = c + 1 < edges.begins.size() ? edges.begins[c + 1] : int(edges.at.size());
    lengths.push_back(end - edges.begins[c]);
  }
  return lengths;
}

void add_edges(const PackedEdges& edges, PieceWriter* out) {
  const std::vector<int> lengths = lengths_of(edges);
  std::vector<int> x, y, normal;
  ChainPredictor predictor;
  size_t i = 0;
  uint8_t last_normal = 0;
  for (const int length : lengths)
    for (int k = 0; k < length; ++k, ++i) {
      const int px = edges.at[i][0], py = edges.at[i][1];
      x.push_back(px - predictor.expected(0)), y.push_back(py - predictor.expected(1));
      predictor.note(px, py, k == 0);
      normal.push_back(int8_t(uint8_t(edges.normal[i] - last_normal)));
      last_normal = edges.normal[i];
    }
  out->add_small(lengths);
  out->add_small(x);
  out->add_small(y);
  out->add_small(normal);
}

// Whether the lengths are those of edges that have so many pixels in all.
bool add_up(const std::vector<int>& lengths, size_t pixels) {
  size_t sum = 0;
  for (const int length : lengths) {
    if (length < 0 || size_t(length) > pixels - sum) return false;
    sum += size_t(length);
  }
  return sum == pixels;
}

bool read_edges(size_t pixels, size_t chains, PieceReader* in, PackedEdges* edges) {
  const std::vector<int> lengths = in->next_small(chains), x = in->next_small(pixels),
                         y = in->next_small(pixels), normal = in->next_small(pixels);
  if (!in->ok() || !add_up(lengths, pixels)) return false;
  edges->at.reserve(pixels), edges->normal.reserve(pixels);
  ChainPredictor predictor;
  uint8_t last_normal = 0;
  for (const int length : lengths) {
    edges->begins.push_back(int32_t(edges->at.size()));
    for (int k = 0; k < length; ++k) {
      const size_t i = edges->at.size();
      const uint16_t px = uint16_t(predictor.expected(0) + x[i]), py = uint16_t(predictor.expected(1) + y[i]);
      predictor.note(px, py, k == 0);
      edges->at.push_back({px, py});
      edges->normal.push_back(last_normal = uint8_t(last_normal + normal[i]));
    }
  }
  return true;
}

}  // namespace

std::string bytes_of(const RememberedView& view) {
  PieceWriter out;
  out.add(head_of(view));
  add_corners(view.corners, &out);
  add_edges(view.edges, &out);
  return out.bytes();
}

std::optional<RememberedView> read_view(std::string_view bytes) {
  PieceReader pieces(bytes);
  const std::string head = pieces.next();
  ValueReader in(head);
  const size_t corners = in.value<uint32_t>(), pixels = in.value<uint32_t>(), chains = in.value<uint32_t>();
  RememberedView view;
  view.edges.pinhole = in.value<Pinhole>();
  view.signature.bits = in.value<decltype(view.signature.bits)>();
  view.light = in.value<ViewLight>();
  if (!in.ok() || corners > kMaxCorners || pixels > kMaxEdgePixels || chains > pixels) return std::nullopt;
  view.corners = read_corners(corners, &pieces);
  const bool is_whole = read_edges(pixels, chains, &pieces, &view.edges);
  if (!is_whole || view.corners.descriptors.size() != corners) return std::nullopt;
  return view;
}

}  // namespace edgevo
