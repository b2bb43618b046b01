#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/output_place.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/run_calibration.h"
#include "option_checks.h"

namespace edgevo::app {
namespace {

struct CalibrateArguments {
  std::string run, out, camera_file;
  bool force = false;
};

RunCalibration calibration_as_asked(const CalibrateArguments& args) {
  RunCalibration run = read_run_calibration(args.run);
  if (args.camera_file.empty()) return run;
  const Camera camera = read_camera_file(args.camera_file);
  if (camera.pinhole.width != run.camera.pinhole.width || camera.pinhole.height != run.camera.pinhole.height)
    throw InputError(args.camera_file, "its image size is not that of the run", "give the camera file that the run was given");
  run.camera = camera;
  return run;
}

std::string finding(const CameraRefinement& c) {
  if (c.state == CameraRefinement::State::kInsignificant)
    return "no significant residual distortion (k1 " + fixed(c.estimate, 4) + " +- " + fixed(c.sigma, 4) + ", " +
           std::to_string(c.keyframes) + " keyframes): the camera is left as it was";
  return "residual k1 " + fixed(c.k1, 4) + " +- " + fixed(c.sigma, 4) + " (one standard deviation), from " + std::to_string(c.keyframes) +
         " keyframes";
}

void print_lens(const char* name, const Distortion& d) {
  std::printf("  %-7s %11.6f %11.6f %11.6f %11.6f %11.6f\n", name, d.k1, d.k2, d.p1, d.p2, d.k3);
}

void print_change(const Camera& before, const FoldedCamera& after) {
  std::printf("  %-7s %11s %11s %11s %11s %11s\n", "", "k1", "k2", "p1", "p2", "k3");
  print_lens("before", before.distortion);
  print_lens("after", after.camera.distortion);
  std::printf("image points move by up to %.2f px; this one lens is within %.4f px of both together, rms %.4f px\n", after.max_shift_px,
              after.max_error_px, after.rms_error_px);
}

int calibrate(const CalibrateArguments& args) {
  check_not_there(args.out, args.force);
  const RunCalibration run = calibration_as_asked(args);
  const FoldedCamera corrected = corrected_camera(run);
  const std::string found = finding(run.refinement);
  write_file(args.out, camera_yaml(corrected.camera, "Self-calibration of edgevo: " + found));
  std::printf("%s: %s\n", run.path.c_str(), found.c_str());
  if (run.refinement.k1 != 0) print_change(run.camera, corrected);
  if (run.refinement.shutter.readout_s != 0)
    std::printf("the shutter rolls, read-out %.4f s: no camera file says that; give it with --set camera.readout_s=%.4f\n",
                run.refinement.shutter.readout_s, run.refinement.shutter.readout_s);
  std::printf("%s: a camera file for --camera, MRPT, OpenCV and ROS\n", args.out.c_str());
  return 0;
}

}  // namespace

void add_calibrate_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand("calibrate", "a camera file with the lens distortion that a run has found");
  auto args = std::make_shared<CalibrateArguments>();
  command->add_option("RUN", args->run, "the folder of results of a finished `edgevo run`")->required();
  command->add_option("-o,--out", args->out, "camera file to write (YAML)")->required()->check(path_given());
  command->add_option("--camera", args->camera_file, "the camera file that the run was given (default: as the run noted it)");
  add_force(*command, &args->force);
  command->callback([=] { *action = [=] { return calibrate(*args); }; });
}

}  // namespace edgevo::app
