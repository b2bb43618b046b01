#include "wall_patches.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace edgevo {
namespace {

using Lines = std::vector<const WallLine*>;

// Keyframes that saw both.
int shared(const WallLine& a, const WallLine& b) {
  return std::min(a.last, b.last) - std::max(a.first, b.first) + 1;
}

// For each line, those that some keyframe saw with it.
std::vector<Lines> seen_together(const std::vector<WallLine>& lines) {
  std::vector<Lines> together(lines.size());
  for (size_t i = 0; i < lines.size(); ++i)
    for (size_t j = i + 1; j < lines.size() && lines[j].first <= lines[i].last; ++j) {
      together[i].push_back(&lines[j]);
      together[j].push_back(&lines[i]);
    }
  return together;
}

// The stretch that parallel lines have beside each other: corners 0 and 1 on a, 2 and 3 on b.
std::optional<WallPatch> between(const WallLine& a, WallLine b, const PatchRules& rules) {
  const Eigen::Vector3d along = a.direction();
  if (b.direction().dot(along) < 0) std::swap(b.begin, b.end);
  if (b.direction().dot(along) < kParallel) return {};
  const double b_begin = along.dot(b.begin - a.begin), b_end = along.dot(b.end - a.begin);
  const double low = std::max(0.0, b_begin), high = std::min(a.length(), b_end);
  if (high - low < rules.least_side) return {};
  const auto on_a = [&](double s) { return Eigen::Vector3d(a.begin + s * along); };
  const auto on_b = [&](double s) {
    return Eigen::Vector3d(b.begin + (b.end - b.begin) * (s - b_begin) / (b_end - b_begin));
  };
  for (const double s : {low, high})
    if (const double gap = (on_a(s) - on_b(s)).norm(); gap < rules.least_side || gap > rules.most_side)
      return {};
  return WallPatch({on_a(low), on_a(high), on_b(high), on_b(low)});
}

// Over more than half its length, one line or another runs along the side.
bool is_closed(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Lines& lines, double gap) {
  constexpr int kPlaces = 5;
  constexpr double kAlong = 0.9;  // |cos|: 26 degrees
  const Eigen::Vector3d side = (to - from).normalized();
  int closed = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Eigen::Vector3d p = from + (to - from) * (i + 0.5) / kPlaces;
    closed += std::any_of(lines.begin(), lines.end(), [&](const WallLine* line) {
      return line->distance(p) <= gap && std::abs(line->direction().dot(side)) > kAlong;
    });
  }
  return 2 * closed > kPlaces;
}

bool is_framed(const WallPatch& patch, const Lines& lines, double gap) {
  const WallPatch::Corners& c = patch.corners();
  return is_closed(c[1], c[2], lines, gap) || is_closed(c[3], c[0], lines, gap);
}

}  // namespace

std::vector<WallPatch> wall_patches(const std::vector<WallLine>& lines, const PatchRules& rules) {
  const std::vector<Lines> together = seen_together(lines);
  std::vector<WallPatch> patches;
  for (size_t i = 0; i < lines.size(); ++i)
    for (const WallLine* other : together[i]) {
      if (other < &lines[i] || shared(lines[i], *other) < rules.min_keyframes) continue;  // each pair once
      const auto patch = between(lines[i], *other, rules);
      if (patch && patch->bend() <= rules.thickness && is_framed(*patch, together[i], rules.frame_gap))
        patches.push_back(*patch);
    }
  return patches;
}

}  // namespace edgevo
