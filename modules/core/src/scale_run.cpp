#include "edgevo/core/scale_run.h"

#include <cmath>
#include <cstdlib>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

SE3 scaled(const SE3& T, double factor) { return {T.rotation(), factor * T.translation()}; }

// The factor of "factor=VALUE"; 1 for "none".
double parse_factor(const std::string& option) {
  const std::string prefix = "factor=";
  if (option == "none") return 1.0;
  if (option.rfind(prefix, 0) != 0)
    throw InputError("--scale " + option, "is not a scale source of this version", "give none or factor=METRES_PER_UNIT");
  const std::string text = option.substr(prefix.size());
  char* end = nullptr;
  const double factor = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(factor > 0) || !std::isfinite(factor))
    throw InputError("--scale " + option, "the factor is not a positive number", "give for example factor=2.5");
  return factor;
}

}  // namespace

void scale_run(double factor, const std::string& source, Run* run) {
  if (!(factor > 0) || !std::isfinite(factor))
    throw InputError("scale", "the factor is not a positive number", "give metres per unit of the run");
  Vector6d unit = Vector6d::Ones();
  unit.head<3>().setConstant(factor);
  for (FrameRecord& f : run->frames) {
    if (f.T_world_cam) f.T_world_cam = scaled(*f.T_world_cam, factor);
    if (f.T_world_cam_live) f.T_world_cam_live = scaled(*f.T_world_cam_live, factor);
    f.covariance = unit.asDiagonal() * f.covariance * unit.asDiagonal();
  }
  for (KeyframeRecord& k : run->keyframes) {
    k.T_world_cam = scaled(k.T_world_cam, factor);
    for (EdgePoint& p : k.points) p.idepth = float(p.idepth / factor), p.idepth_sigma = float(p.idepth_sigma / factor);
  }
  run->scale_source = source;
}

void check_scale_option(const std::string& option) { parse_factor(option); }

void apply_scale_option(const std::string& option, Run* run) {
  const double factor = parse_factor(option);
  if (option != "none") scale_run(factor, option, run);
}

}  // namespace edgevo
