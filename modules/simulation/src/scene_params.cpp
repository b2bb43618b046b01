// SPDX-License-Identifier: BSD-3-Clause
#include "scene_params.h"

#include <charconv>
#include <sstream>
#include <string_view>

#include "drawn_params.h"
#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr const char* kKey = "way_points:";
constexpr const char* kRemedy =
    "write each waypoint on a line of its own as `- [x, y]` or `- [x, y, z]`, metres";

std::string at_line(const std::string& file, int line) { return file + ":" + std::to_string(line); }

std::string_view trimmed(std::string_view s) {
  constexpr std::string_view kBlanks = " \t\r";
  const size_t begin = s.find_first_not_of(kBlanks);
  return begin == std::string_view::npos ? std::string_view()
                                         : s.substr(begin, s.find_last_not_of(kBlanks) - begin + 1);
}
std::string_view without_comment(std::string_view line) { return trimmed(line.substr(0, line.find('#'))); }

bool opens_waypoints(const std::string& line) {
  return line.compare(0, std::string_view(kKey).size(), kKey) == 0;
}
// A line outside any list or group, which ends the section before it.
bool is_top_level_key(const std::string& line) {
  return !line.empty() && line[0] != ' ' && line[0] != '\t' && line[0] != '#' && line[0] != '-' &&
         line[0] != '\r';
}

// "[x, y]" or "[x, y, z]".
bool parse_point(std::string_view text, Eigen::Vector3d* p) {
  if (text.size() < 2 || text.front() != '[' || text.back() != ']') return false;
  text = text.substr(1, text.size() - 2);
  int count = 0;
  for (bool more = true; more; ++count) {
    const size_t comma = text.find(',');
    more = comma != std::string_view::npos;
    const std::string_view digits = trimmed(text.substr(0, comma));
    const char* const end = digits.data() + digits.size();
    if (count == 3) return false;
    const auto read = std::from_chars(digits.data(), end, (*p)[count]);
    if (read.ec != std::errc() || read.ptr != end) return false;
    if (more) text.remove_prefix(comma + 1);
  }
  return count >= 2;
}

Eigen::Vector3d parse_item(std::string_view item, const std::string& where) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  if (item.front() != '-' || !parse_point(trimmed(item.substr(1)), &p))
    throw InputError(where, "is not a waypoint: a list of two or three numbers", kRemedy);
  if (!(p.cwiseAbs().maxCoeff() < 1e5)) throw InputError(where, "a waypoint is beyond 100 km", kRemedy);
  return p;
}

// Removes the waypoints from the text, whose other lines keep their numbers.
std::string take_waypoints(std::istream& in, const std::string& file, SceneParams* params) {
  std::string line, rest;
  bool inside = false;
  for (int number = 1; std::getline(in, line); ++number) {
    if (is_top_level_key(line)) inside = opens_waypoints(line);
    rest += (inside ? "" : line) + "\n";
    const std::string where = at_line(file, number);
    if (inside && opens_waypoints(line)) {
      if (!params->where.waypoints.empty())
        throw InputError(where, "way_points was given already", "keep one");
      params->where.waypoints = where;
      if (!without_comment(std::string_view(line).substr(std::string_view(kKey).size())).empty())
        throw InputError(where, "something follows way_points on its line", kRemedy);
    } else if (inside && !without_comment(line).empty()) {
      params->waypoints.push_back(parse_item(without_comment(line), where));
    }
  }
  return rest;
}

// The line of `key`, which may be missing, in the group `world`.
std::string where_in_world(const std::string& text, const std::string& key, const std::string& file) {
  std::istringstream in(text);
  std::string line;
  bool inside = false;
  for (int number = 1; std::getline(in, line); ++number) {
    if (is_top_level_key(line)) inside = line.compare(0, 6, "world:") == 0;
    if (inside && trimmed(line).substr(0, key.size() + 1) == key + ":") return at_line(file, number);
  }
  return file;
}

void check_waypoints(const SceneParams& params, const std::string& file) {
  const std::string& where = params.where.waypoints;
  if (is_drawn(params.world.kind)) {
    if (!where.empty())
      throw InputError(where, "the way_points of " + params.world.kind + " are drawn from the seed",
                       "remove them");
    return;
  }
  if (where.empty()) throw InputError(file, "has no way_points", kRemedy);
  if (params.waypoints.size() < 2) throw InputError(where, "has fewer than two waypoints", kRemedy);
}

}  // namespace

SceneParams parse_scene(const std::string& text, const std::string& file) {
  SceneParams params;
  std::istringstream in(text);
  const std::string rest = take_waypoints(in, file, &params);
  read_params(rest, file, [&](ParamVisitor& v) { params.visit(v); });
  if (params.frames < 1)
    throw InputError(file, "frames is missing: the scene would be empty", "give for example frames: 300");
  check_waypoints(params, file);
  params.where.walls = where_in_world(text, "walls", file);
  params.where.sky = where_in_world(text, "sky", file);
  params.camera.camera.check(file);
  return params;
}

}  // namespace edgevo
