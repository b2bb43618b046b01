// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bytes_of_values.h"
#include "keyframe_bytes.h"

namespace edgevo {
namespace {

constexpr double kPerPixel = 16;
constexpr double kPerTurn = 256 / (2 * M_PI);
// Inverse depths by their logarithms: from 1e-7 to 1e5 per unit of length, whatever the unit, 0.042 % apart.
constexpr double kLeastLog = -16.1, kLogStep = 27.6 / 65535;
// Their standard deviations over themselves, from 1e-4 to 10, 4.6 % apart; 0: unknown.
constexpr double kLeastRatioLog = -9.21, kRatioLogStep = 11.5 / 254;
constexpr size_t kMaxPoints = 1 << 20;

uint16_t in_16_bits(double value) { return uint16_t(std::clamp(std::lround(value), 0L, 65535L)); }
uint8_t in_8_bits(double value, long least) { return uint8_t(std::clamp(std::lround(value), least, 255L)); }

uint8_t packed_sigma(const EdgePoint& p) {
  if (!(p.idepth_sigma > 0)) return 0;
  return in_8_bits(1 + (std::log(double(p.idepth_sigma) / p.idepth) - kLeastRatioLog) / kRatioLogStep, 1);
}

bool is_kept(const EdgePoint& p) {
  return p.idepth > 0 && std::isfinite(p.idepth) && p.px.x() >= 0 && p.px.y() >= 0;
}

void append_pose(const SE3& T, std::string* bytes) {
  const Eigen::Quaterniond& q = T.rotation();
  for (const double v : {q.w(), q.x(), q.y(), q.z()}) append_value(bytes, v);
  for (int i = 0; i < 3; ++i) append_value(bytes, T.translation()[i]);
}

std::optional<SE3> read_pose(ValueReader* in) {
  double v[7];
  for (double& one : v) one = in->value<double>();
  const SE3 T(Eigen::Quaterniond(v[0], v[1], v[2], v[3]), {v[4], v[5], v[6]});
  if (!T.is_finite()) return std::nullopt;
  return T;
}

std::string head_of(const KeyframePlace& place, size_t points) {
  std::string head;
  append_value(&head, int32_t(place.id));
  append_value(&head, int32_t(place.epoch));
  append_value(&head, int32_t(place.record.frame_index));
  append_value(&head, int32_t(place.record.segment));
  append_value(&head, place.record.time.ticks);
  append_pose(place.record.T_world_cam, &head);
  append_value(&head, uint32_t(points));
  return head;
}

// The points as columns of values.
struct Columns {
  std::vector<uint16_t> x, y, depth;
  std::string normal, sigma, observations, gray;

  void add(const EdgePoint& p) {
    x.push_back(in_16_bits(p.px.x() * kPerPixel));
    y.push_back(in_16_bits(p.px.y() * kPerPixel));
    depth.push_back(in_16_bits((std::log(double(p.idepth)) - kLeastLog) / kLogStep));
    normal += char(std::lround(std::atan2(p.normal.y(), p.normal.x()) * kPerTurn) & 255);
    sigma += char(packed_sigma(p));
    observations += char(in_8_bits(p.observations, 0));
    gray += char(p.gray);
  }
  EdgePoint point(size_t i) const {
    EdgePoint p;
    p.px = {float(x[i] / kPerPixel), float(y[i] / kPerPixel)};
    const double angle = uint8_t(normal[i]) / kPerTurn;
    p.normal = {float(std::cos(angle)), float(std::sin(angle))};
    const double idepth = std::exp(kLeastLog + depth[i] * kLogStep);
    p.idepth = float(idepth);
    if (sigma[i] != 0)
      p.idepth_sigma = float(idepth * std::exp(kLeastRatioLog + (uint8_t(sigma[i]) - 1) * kRatioLogStep));
    p.observations = uint8_t(observations[i]);
    p.gray = uint8_t(gray[i]);
    return p;
  }
};

bool read_points(PieceReader* in, size_t count, std::vector<EdgePoint>* points) {
  if (count > kMaxPoints) return false;
  Columns columns;
  columns.x = in->next_16(count), columns.y = in->next_16(count), columns.depth = in->next_16(count);
  for (std::string* column : {&columns.normal, &columns.sigma, &columns.observations, &columns.gray}) {
    *column = in->next();
    if (column->size() != count) return false;
  }
  if (!in->ok()) return false;
  for (size_t i = 0; i < count; ++i) points->push_back(columns.point(i));
  return true;
}

}  // namespace

std::string bytes_of(const KeyframePlace& place) {
  Columns columns;
  for (const EdgePoint& p : place.record.points)
    if (is_kept(p)) columns.add(p);
  PieceWriter out;
  out.add(head_of(place, columns.x.size()));
  for (const auto* column : {&columns.x, &columns.y, &columns.depth}) out.add(*column);
  for (const auto* column : {&columns.normal, &columns.sigma, &columns.observations, &columns.gray})
    out.add(*column);
  return out.bytes();
}

std::optional<KeyframePlace> read_place(std::string_view bytes) {
  PieceReader pieces(bytes);
  const std::string head = pieces.next();
  ValueReader in(head);
  KeyframePlace place;
  place.id = in.value<int32_t>();
  place.epoch = in.value<int32_t>();
  place.record.frame_index = in.value<int32_t>();
  place.record.segment = in.value<int32_t>();
  place.record.time.ticks = in.value<int64_t>();
  const std::optional<SE3> pose = read_pose(&in);
  const auto count = in.value<uint32_t>();
  if (!in.ok() || !pose || !read_points(&pieces, count, &place.record.points)) return std::nullopt;
  place.record.T_world_cam = *pose;
  return place;
}

}  // namespace edgevo
