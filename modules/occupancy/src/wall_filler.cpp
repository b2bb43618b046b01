#include "wall_filler.h"

#include <algorithm>
#include <optional>

namespace edgevo {
namespace {

// A piece whose ends are certain and near enough; nothing else frames a wall.
std::optional<WallLine> wall_line(const Run& run, const EdgeLine& line, int keyframe, const SE3& T_map_cam,
                                  const FillRules& rules) {
  if (!line.is_straight || line.is_outline) return {};
  for (const EdgeVertex* v : {&line.vertices.front(), &line.vertices.back()})
    if (v->idepth_sigma > rules.max_relative_sigma * v->idepth ||
        point_in_camera(run.pinhole, *v).norm() > rules.max_range)
      return {};
  WallLine wall{T_map_cam * point_in_camera(run.pinhole, line.vertices.front()),
                T_map_cam * point_in_camera(run.pinhole, line.vertices.back()), keyframe,
                keyframe + std::max(line.keyframes, 1) - 1};
  if (wall.length() == 0) return {};
  return wall;
}

std::vector<WallLine> lines_of(const Run& run, const std::vector<const KeyframeRecord*>& keyframes,
                               const FillRules& rules) {
  const SE3 T_map = T_map_world(run);
  std::vector<WallLine> pieces;
  for (size_t k = 0; k < keyframes.size(); ++k)
    for (const EdgeLine& line : keyframes[k]->lines)
      if (const auto piece = wall_line(run, line, int(k), T_map * keyframes[k]->T_world_cam, rules))
        pieces.push_back(*piece);
  std::vector<WallLine> lines = joined(pieces, rules.line_width, rules.line_gap);
  lines.erase(std::remove_if(lines.begin(), lines.end(),
                             [&](const WallLine& line) { return line.length() < rules.patches.least_side; }),
              lines.end());
  return lines;
}

}  // namespace

// All lengths follow the voxels, which tell how finely the map is wanted, and the range.
FillRules fill_rules(const OccupancyParams& params, double resolution, double max_range) {
  FillRules rules;
  rules.line_width = 0.25 * resolution;
  rules.line_gap = 4 * resolution;
  rules.patches.thickness = 0.5 * resolution;
  rules.patches.least_side = 2 * resolution;
  rules.patches.most_side = 0.25 * max_range;
  rules.patches.frame_gap = 2 * resolution;
  rules.max_range = max_range;
  rules.max_relative_sigma = params.carve_max_relative_sigma;
  return rules;
}

WallFiller::WallFiller(const Run& run, const std::vector<const KeyframeRecord*>& keyframes,
                       const FillRules& rules)
    : rules_(rules), patches_(wall_patches(lines_of(run, keyframes, rules), rules.patches)) {
  is_open_.assign(patches_.size(), false);
  const SE3 T_map = T_map_world(run);
  for (size_t k = 1; k < keyframes.size(); ++k)
    drive_through((T_map * keyframes[k - 1]->T_world_cam).translation(),
                  (T_map * keyframes[k]->T_world_cam).translation());
}

void WallFiller::drive_through(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  look_from(from);
  constexpr double kNoThickness = 0;
  for (const size_t i : in_reach_)
    if (patches_[i].is_crossed(from, to, kNoThickness)) is_open_[i] = true;
}

void WallFiller::look_from(const Eigen::Vector3d& eye) {
  eye_ = eye;
  in_reach_.clear();
  for (size_t i = 0; i < patches_.size(); ++i)
    if (!is_open_[i] && (patches_[i].middle() - eye).norm() - patches_[i].radius() <= 2 * rules_.max_range)
      in_reach_.push_back(i);
}

void WallFiller::see_through(const Eigen::Vector3d& end) {
  const auto opens = [&](size_t i) {
    is_open_[i] = patches_[i].is_crossed(eye_, end, rules_.patches.thickness);
    return is_open_[i];
  };
  in_reach_.erase(std::remove_if(in_reach_.begin(), in_reach_.end(), opens), in_reach_.end());
}

std::vector<WallPatch> WallFiller::walls() const {
  std::vector<WallPatch> walls;
  for (size_t i = 0; i < patches_.size(); ++i)
    if (!is_open_[i]) walls.push_back(patches_[i]);
  return walls;
}

int WallFiller::opened() const { return int(std::count(is_open_.begin(), is_open_.end(), true)); }

}  // namespace edgevo
