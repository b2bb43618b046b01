// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/run_calibration.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include "edgevo/calibration/camera_difference.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/params.h"
#include "edgevo/datasets/camera_file.h"

namespace edgevo {
namespace {

using State = CameraPosterior::State;

constexpr int kLargestSide = 65535;  // pixels of a width or height: what image formats hold

// Remedy in every message about the folder.
constexpr const char* kRemedy = "give the folder that a finished `edgevo run` of this version has written";

// The text with the lines outside the two groups blanked, so that the others keep their line numbers.
std::string camera_groups(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line[0] != ' ') inside = line == "camera:" || line == "self_calibration:";
    kept += (inside ? line : "") + '\n';
  }
  return kept;
}

struct Numbers {
  double largest = std::numeric_limits<double>::max();
  void read(KeyVisitor& v, const char* key, double& value) const {
    v.number(key, value, -largest, largest, "");
  }
};

void visit_camera(KeyVisitor& v, Camera* camera) {
  const auto g = v.group("camera");
  Pinhole p = camera->pinhole();
  Distortion d = camera->distortion();
  v.integer("width", p.width, 1, kLargestSide, "");
  v.integer("height", p.height, 1, kLargestSide, "");
  const Numbers any;
  for (const auto& [key, value] : {std::pair("fx", &p.fx), {"fy", &p.fy}, {"cx", &p.cx}, {"cy", &p.cy}})
    any.read(v, key, *value);
  for (const auto& [key, value] :
       {std::pair("k1", &d.k1), {"k2", &d.k2}, {"p1", &d.p1}, {"p2", &d.p2}, {"k3", &d.k3}})
    any.read(v, key, *value);
  *camera = Camera(p, d);
}

State state_named(const std::string& name) {
  const auto& names = camera_state_names();
  return State(std::find(names.begin(), names.end(), name) - names.begin());
}

// A number of the posterior and its standard deviation.
void read_number(KeyVisitor& v, const std::string& value_key, const std::string& sigma_key, CameraNumber n,
                 CameraGaussian* g) {
  double value = 0, sigma = 0;
  const Numbers any;
  any.read(v, value_key.c_str(), value);
  any.read(v, sigma_key.c_str(), sigma);
  g->set(n, value, sigma);
}

void visit_posterior(KeyVisitor& v, std::string* k1_state, CameraPosterior* c) {
  const auto g = v.group("self_calibration");
  std::string result;  // the states in words
  const std::string off = to_string(State::kOff);
  std::string shutter = off, focal = off;
  constexpr int kMost = std::numeric_limits<int>::max();
  const Numbers any;
  v.text("state", *k1_state, camera_state_names(), "");
  v.text("result", result, {}, "");
  any.read(v, "residual_k1", c->applied.k1);
  read_number(v, "estimate", "standard_deviation", CameraNumber::kK1, &c->given);
  v.integer("keyframes", c->given.keyframes, 0, kMost, "");
  v.text("focal", focal, camera_state_names(), "");
  v.text("focal_result", result, {}, "");
  any.read(v, "residual_focal", c->applied.focal);
  any.read(v, "focal_estimate", c->corners.focal);
  any.read(v, "focal_standard_deviation", c->corners.sigma);
  v.integer("focal_windows", c->corners.windows, 0, kMost, "");
  v.text("shutter", shutter, camera_state_names(), "");
  v.text("shutter_result", result, {}, "");
  any.read(v, "readout_s", c->applied.readout_s);
  read_number(v, "readout_estimate", "readout_standard_deviation", CameraNumber::kReadout, &c->given);
  v.integer("readout_keyframes", c->given.keyframes, 0, kMost, "");
  v.text("lens_result", result, {}, "");
  read_number(v, "lens_k1", "lens_k1_standard_deviation", CameraNumber::kK1, &c->whole);
  read_number(v, "lens_k2", "lens_k2_standard_deviation", CameraNumber::kK2, &c->whole);
  read_number(v, "lens_focal", "lens_focal_standard_deviation", CameraNumber::kFocal, &c->whole);
  v.integer("lens_keyframes", c->whole.keyframes, 0, kMost, "");
  // What is stated has what matches may miss in it.
  const double focal_error = c->whole.mean_of(CameraNumber::kFocal),
               stated = c->whole.sigma_of(CameraNumber::kFocal),
               missed = kMissedByMatches * (focal_error - c->applied.focal);
  c->whole.set(CameraNumber::kFocal, focal_error,
               std::sqrt(std::max(0.0, stated * stated - missed * missed)));
  c->is_sought = {*k1_state != off && !k1_state->empty(), shutter != off, false, focal != off};
  if (shutter == off) c->readout_given_s = c->applied.readout_s;
}

}  // namespace

RunCalibration read_run_calibration(const std::string& run_folder) {
  RunCalibration run;
  run.path = (std::filesystem::path(run_folder) / "summary.yaml").string();
  std::string state;
  const std::string groups = camera_groups(read_file(run.path, kRemedy));
  if (groups.find("\n  lens: ") != std::string::npos)
    throw InputError(run.path, "the lens is not plumb-bob: what a run finds cannot be folded into its model",
                     "calibrate from a board (edgevo calibrate --chessboard)");
  read_params(groups, run.path, [&](ParamVisitor& v) {
    visit_camera(v, &run.camera);
    visit_posterior(v, &state, &run.refinement);
  });
  if (run.camera.width == 0) throw InputError(run.path, "holds no camera", kRemedy);
  if (state.empty()) throw InputError(run.path, "lacks the state of self_calibration", kRemedy);
  run.camera.check(run.path);
  run.k1_state = state_named(state);
  return run;
}

RunCalibration read_run_calibration(const std::string& run_folder, const std::string& camera_file) {
  RunCalibration run = read_run_calibration(run_folder);
  if (camera_file.empty()) return run;
  const Camera camera = read_camera_file(camera_file);
  if (camera.width != run.camera.width || camera.height != run.camera.height)
    throw InputError(camera_file, "its image size is not that of the run",
                     "give the camera file that the run used");
  constexpr double kSame_px = 0.1;  // summary.yaml has nine digits
  if (const double difference = largest_difference_px(run.camera, camera); difference > kSame_px)
    throw InputError(camera_file,
                     "is another camera than that of the run: points differ by up to " +
                         (difference < 1e4 ? fixed(difference, 1) + " px" : "the whole image"),
                     "give the camera file that the run used, or run again with this one");
  run.camera = camera;
  return run;
}

FoldedCamera corrected_camera(const RunCalibration& run) {
  // Whatever is known of k1.
  if (run.refinement.applied.focal != 0) return fold_residual(run.camera, run.refinement.applied, run.path);
  switch (run.k1_state) {
    case State::kOff:
      throw InputError(run.path, "self-calibration was off", "run again without --set camera.refine=none");
    case State::kTooEarly:
      throw InputError(run.path, "the run was too short to calibrate the camera",
                       "run on a longer sequence: 60 keyframes and more");
    case State::kNotObservable:
      throw InputError(
          run.path, "the motion does not determine the camera's distortion",
          "run on a sequence that moves forward over a longer distance, past structure near and far");
    case State::kAtLimit:
      throw InputError(
          run.path,
          "the distortion that was found is at its limit: the camera file is wrong in some other way",
          "calibrate the camera (edgevo calibrate --chessboard)");
    case State::kInsignificant:
    case State::kApplied:
      break;
  }
  return fold_residual(run.camera, run.refinement.applied, run.path);
}

}  // namespace edgevo
