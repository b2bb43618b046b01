// SPDX-License-Identifier: BSD-3-Clause
#include "scene_params.h"

#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "drawn_params.h"
#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr const char* kRemedy =
    "write each waypoint on a line of its own as `- [x, y]` or `- [x, y, z]`, metres";
constexpr const char* kStreetRemedy =
    "write each street on a line of its own as `- [x, y, x, y]`, its two ends in metres";

// A list of lists of numbers, each on a line of its own.
struct ListSection {
  std::string key, item, remedy;
  size_t min_numbers, max_numbers;
  std::string where = {};
  std::vector<std::vector<double>> items = {};
};

std::string at_line(const std::string& file, int line) { return file + ":" + std::to_string(line); }

std::string_view trimmed(std::string_view s) {
  constexpr std::string_view kBlanks = " \t\r";
  const size_t begin = s.find_first_not_of(kBlanks);
  return begin == std::string_view::npos ? std::string_view()
                                         : s.substr(begin, s.find_last_not_of(kBlanks) - begin + 1);
}
std::string_view without_comment(std::string_view line) { return trimmed(line.substr(0, line.find('#'))); }

bool opens(const ListSection& list, const std::string& line) {
  return line.compare(0, list.key.size() + 1, list.key + ":") == 0;
}
// A line outside any list or group, which ends the section before it.
bool is_top_level_key(const std::string& line) {
  return !line.empty() && line[0] != ' ' && line[0] != '\t' && line[0] != '#' && line[0] != '-' &&
         line[0] != '\r';
}

// "[x, y, ..]"; empty if it is something else.
std::vector<double> parse_numbers(std::string_view text) {
  if (text.size() < 2 || text.front() != '[' || text.back() != ']') return {};
  text = text.substr(1, text.size() - 2);
  std::vector<double> numbers;
  for (bool more = true; more;) {
    const size_t comma = text.find(',');
    more = comma != std::string_view::npos;
    const std::string_view digits = trimmed(text.substr(0, comma));
    const char* const end = digits.data() + digits.size();
    numbers.emplace_back();
    const auto read = std::from_chars(digits.data(), end, numbers.back());
    if (read.ec != std::errc() || read.ptr != end) return {};
    if (more) text.remove_prefix(comma + 1);
  }
  return numbers;
}

std::vector<double> parse_item(std::string_view item, const ListSection& list, const std::string& where) {
  const std::vector<double> numbers =
      item.front() == '-' ? parse_numbers(trimmed(item.substr(1))) : std::vector<double>();
  if (numbers.size() < list.min_numbers || numbers.size() > list.max_numbers)
    throw InputError(where, "is not " + list.item, list.remedy);
  for (const double number : numbers)
    if (!(std::abs(number) < 1e5))
      throw InputError(where, "a " + list.item.substr(2, list.item.find(':') - 2) + " is beyond 100 km",
                       list.remedy);
  return numbers;
}

void open_list(const std::string& line, const std::string& where, ListSection* list) {
  if (!list->where.empty()) throw InputError(where, list->key + " was given already", "keep one");
  list->where = where;
  if (!without_comment(std::string_view(line).substr(list->key.size() + 1)).empty())
    throw InputError(where, "something follows " + list->key + " on its line", list->remedy);
}

// Removes a list from the text, whose other lines keep their numbers.
std::string take_list(const std::string& text, const std::string& file, ListSection* list) {
  std::istringstream in(text);
  std::string line, rest;
  bool inside = false;
  for (int number = 1; std::getline(in, line); ++number) {
    if (is_top_level_key(line)) inside = opens(*list, line);
    rest += (inside ? "" : line) + "\n";
    const std::string where = at_line(file, number);
    if (inside && opens(*list, line))
      open_list(line, where, list);
    else if (inside && !without_comment(line).empty())
      list->items.push_back(parse_item(without_comment(line), *list, where));
  }
  return rest;
}

// Removes the waypoints and the streets from the text.
std::string take_lists(const std::string& text, const std::string& file, SceneParams* params) {
  ListSection points{"way_points", "a waypoint: a list of two or three numbers", kRemedy, 2, 3};
  ListSection streets{"streets", "a street: a list of four numbers", kStreetRemedy, 4, 4};
  const std::string rest = take_list(take_list(text, file, &points), file, &streets);
  params->where.waypoints = points.where;
  for (const std::vector<double>& p : points.items)
    params->waypoints.emplace_back(p[0], p[1], p.size() > 2 ? p[2] : 0);
  for (const std::vector<double>& s : streets.items) params->streets.push_back({{s[0], s[1]}, {s[2], s[3]}});
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
  for (const Leg& street : params.streets)
    if ((street.to - street.from).norm() < 0.1)
      throw InputError(file, "a street is shorter than 0.1 m", kStreetRemedy);
  if (params.waypoints.size() < 2) throw InputError(where, "has fewer than two waypoints", kRemedy);
  if (params.motion.kind == "hand" && params.waypoints.size() % 2 == 1)
    throw InputError(where, "a hand-held camera needs pairs of waypoints",
                     "after each position give the point at which it looks");
}

}  // namespace

std::vector<Leg> legs_between(const std::vector<Eigen::Vector3d>& waypoints) {
  std::vector<Leg> legs;
  for (size_t i = 0; i + 1 < waypoints.size(); ++i)
    legs.push_back({waypoints[i].head<2>(), waypoints[i + 1].head<2>()});
  return legs;
}

std::vector<Leg> street_legs(const SceneParams& params) {
  return params.streets.empty() ? legs_between(params.waypoints) : params.streets;
}

SceneParams parse_scene(const std::string& text, const std::string& file) {
  SceneParams params;
  const std::string rest = take_lists(text, file, &params);
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
