// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/scale_source.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <vector>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

using Kind = ScaleSource::Kind;

// The list of scale sources. To add one, begin with a line here.
struct Known {
  const char* name;
  Kind kind;
  std::optional<VehicleSensor> sensor;  // the vehicle sensor it needs
  const char* value;                    // name of the value it takes; empty: none
  const char* example;                  // with its value, if it takes one
};
const std::vector<Known> kKnown{
    {"none", Kind::kNone, std::nullopt, "", ""},
    {"factor", Kind::kFactor, std::nullopt, "F", "factor=2.5 (metres per unit)"},
    {"odometry", Kind::kOdometry, VehicleSensor::kOdometry, "", ""},
    {"gps", Kind::kGps, VehicleSensor::kGps, "", ""},
    {"robot_pose", Kind::kRobotPose, VehicleSensor::kRobotPose, "", ""},
    {"camera_height", Kind::kCameraHeight, std::nullopt, "METRES",
     "camera_height=1.65 (metres over the ground)"},
};

// "none, factor=F, ... or camera_height=METRES".
std::string all_sources() {
  std::string list;
  for (const Known& k : kKnown) {
    const char* const before = list.empty() ? "" : &k == &kKnown.back() ? " or " : ", ";
    list += before + std::string(k.name) + (k.value[0] ? "=" : "") + k.value;
  }
  return list + "; or several that are measured, such as odometry,gps";
}

const Known& known_source(const std::string& option, const std::string& name) {
  std::vector<std::string> names;
  for (const Known& k : kKnown) {
    if (name == k.name) return k;
    names.emplace_back(k.name);
  }
  throw InputError("--scale " + option,
                   "is not a source of scale; did you mean " + nearest_name(name, names) + "?",
                   "give " + all_sources());
}

double positive(const std::string& option, const std::string& text, const Known& known) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !(value > 0) || !std::isfinite(value))
    throw InputError("--scale " + option, "'" + text + "' is not a positive number",
                     std::string("give for example ") + known.example);
  // Beyond this, squared lengths leave the range of float, and cells the range of the octree's keys.
  constexpr double kMinScale = 1e-6, kMaxScale = 1e6;
  if (value < kMinScale || value > kMaxScale)
    throw InputError("--scale " + option, "'" + text + "' is not between 0.000001 and 1000000",
                     std::string("give for example ") + known.example);
  return value;
}

ScaleSource one_source(const std::string& option, const std::string& text) {
  const size_t equals = text.find('=');
  const Known& known = known_source(option, text.substr(0, equals));
  const bool takes_value = known.value[0] != '\0', has_value = equals != std::string::npos;
  if (has_value && !takes_value)
    throw InputError("--scale " + option, std::string(known.name) + " takes no value",
                     std::string("give --scale ") + known.name);
  if (!has_value && takes_value)
    throw InputError("--scale " + option, "a number is missing",
                     std::string("give for example ") + known.example);
  return {known.kind, takes_value ? positive(option, text.substr(equals + 1), known) : 0.0, text};
}

void check_together(const ScaleSources& sources) {
  std::set<Kind> kinds;
  for (const ScaleSource& source : sources.list) {
    if (sources.list.size() > 1 && !source.is_estimated())
      throw InputError("--scale " + sources.text, source.text + " goes with no other source",
                       "give it alone, or leave it out");
    if (!kinds.insert(source.kind).second)
      throw InputError("--scale " + sources.text, "names a source twice: " + source.text, "give each once");
  }
}

}  // namespace

std::optional<VehicleSensor> ScaleSource::sensor() const {
  for (const Known& k : kKnown)
    if (k.kind == kind) return k.sensor;
  return std::nullopt;
}

std::optional<double> ScaleSources::camera_height() const {
  for (const ScaleSource& source : list)
    if (source.kind == Kind::kCameraHeight) return source.value;
  return std::nullopt;
}

ScaleSources parse_scale_sources(const std::string& option) {
  ScaleSources sources;
  sources.text = option;
  sources.list.clear();
  for (size_t begin = 0; begin <= option.size();) {
    const size_t end = std::min(option.find(',', begin), option.size());
    sources.list.push_back(one_source(option, option.substr(begin, end - begin)));
    begin = end + 1;
  }
  check_together(sources);
  return sources;
}

ScaleSources recorded_scale_sources(const std::string& scale_source) {
  if (scale_source == kKeptMapScale) return ScaleSource{Kind::kKeptMap, 0, scale_source};
  return parse_scale_sources(scale_source);
}

}  // namespace edgevo
