#include "scene_params.h"

#include <mrpt/containers/yaml.h>

#include <cmath>
#include <sstream>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

using Yaml = mrpt::containers::yaml;
constexpr const char* kRemedy = "write each way point as `- [x, y]` or `- [x, y, z]`, metres";

bool opens_section(const std::string& line, const std::string& key) {
  return line.compare(0, key.size() + 1, key + ":") == 0;
}
// A line of text outside of any list or group: it ends the section before it.
bool is_top_level_key(const std::string& line) {
  return !line.empty() && line[0] != ' ' && line[0] != '\t' && line[0] != '#' && line[0] != '-' && line[0] != '\r';
}

// Cuts the section of a top-level key out of the text and returns it.
std::string take_section(const std::string& key, std::string* text) {
  std::istringstream in(*text);
  std::string line, section, rest;
  bool inside = false;
  while (std::getline(in, line)) {
    if (is_top_level_key(line)) inside = opens_section(line, key);
    (inside ? section : rest) += line + "\n";
  }
  *text = rest;
  return section;
}

Eigen::Vector3d parse_point(const Yaml::node_t& node, const std::string& where) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  if (!node.isSequence() || node.asSequence().size() < 2 || node.asSequence().size() > 3)
    throw InputError(where, "a way point is no list of two or three numbers", kRemedy);
  for (int i = 0; i < int(node.asSequence().size()); ++i) {
    p[i] = Yaml(node.asSequence()[size_t(i)]).as<double>();
    if (!(std::abs(p[i]) < 1e5)) throw InputError(where, "a way point lies beyond 100 km", kRemedy);
  }
  return p;
}

std::vector<Eigen::Vector3d> parse_way_points(const std::string& section, const std::string& where) {
  std::vector<Eigen::Vector3d> points;
  try {
    if (section.empty()) throw InputError(where, "has no way_points", kRemedy);
    const Yaml document = Yaml::FromText(section);
    const Yaml list = document["way_points"];
    if (!list.isSequence()) throw InputError(where, "way_points is no list", kRemedy);
    for (const auto& node : list.asSequence()) points.push_back(parse_point(node, where));
  } catch (const InputError&) {
    throw;
  } catch (const std::exception&) {
    throw InputError(where, "way_points is not readable as a list of numbers", kRemedy);
  }
  if (points.size() < 2) throw InputError(where, "has fewer than two way points", kRemedy);
  return points;
}

}  // namespace

SceneParams parse_scene(const std::string& text, const std::string& where) {
  SceneParams params;
  std::string scalars = text;
  const std::string way_points = take_section("way_points", &scalars);
  read_params(scalars, where, [&](ParamVisitor& v) { params.visit(v); });
  if (params.frames < 1) throw InputError(where, "frames is missing: the scene would be empty", "give for example frames: 300");
  params.way_points = parse_way_points(way_points, where);
  params.camera.camera.check(where);
  return params;
}

}  // namespace edgevo
