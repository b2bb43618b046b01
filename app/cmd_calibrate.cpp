// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "edgevo/calibration/calibrate_camera.h"
#include "edgevo/calibration/calibration_picture.h"
#include "edgevo/calibration/calibration_text.h"
#include "edgevo/calibration/camera_from_motion.h"
#include "edgevo/calibration/run_calibration.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/files/output_folder.h"
#include "option_checks.h"
#include "progress.h"
#include "signals.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

struct CalibrateArguments {
  std::string source, out, camera_file;
  std::string chessboard, charuco, dictionary;
  double square_m = 1, marker_m = 0;
  std::optional<CalibratedLens> lens;
  std::string format = "ros";
  SourceOptions images;
  bool force = false, from_motion = false;
};

void print(const std::string& text) { std::fputs(text.c_str(), stdout); }

int calibrate_from_run(const CalibrateArguments& args) {
  const RunCalibration run = read_run_calibration(args.source, args.camera_file);
  const FoldedCamera corrected = corrected_camera(run);
  write_file(args.out, camera_file_text(corrected.camera, args.format,
                                        "Self-calibration of edgevo: " + finding(run.refinement)));
  print(run_calibration_text(run, corrected));
  print(camera_file_use(args.out, args.format, corrected.camera));
  return 0;
}

Board board_from(const CalibrateArguments& args) {
  const bool charuco = !args.charuco.empty();
  Board board = charuco ? board_of_size(args.charuco, true, "--charuco")
                        : board_of_size(args.chessboard, false, "--chessboard");
  board.square_m = args.square_m;
  board.marker_m = args.marker_m;
  if (!args.dictionary.empty()) board.dictionary = args.dictionary;
  return board;
}

BoardViews views_from(const CalibrateArguments& args) {
  const BoardFinder finder(board_from(args));
  SourceOptions options = args.images;
  options.path = args.source;
  options.any_camera = true;
  options.any_size = true;
  const auto source = open_source(options);
  listen_to_signals();
  Progress progress("finding the board", source->size());
  return collect_views(*source, finder, [&, done = 0]() mutable {
    progress.update(++done);
    return !interrupted();
  });
}

std::string picture_path(const std::string& camera_file) {
  return std::filesystem::path(camera_file).replace_extension(".png").string();
}

// Nullopt for "auto".
std::optional<CalibratedLens> lens_of_option(const std::string& name) {
  for (const CalibratedLens lens :
       {CalibratedLens::kPlumbBob, CalibratedLens::kFisheye, CalibratedLens::kRational})
    if (name == to_string(lens)) return lens;
  return std::nullopt;
}

int calibrate_from_board(const CalibrateArguments& args) {
  const BoardViews views = views_from(args);
  const CameraCalibration c = calibrate_camera(views, args.source, args.lens);
  const std::string picture = picture_path(args.out);
  write_file(args.out, camera_file_text(c.camera, args.format, board_calibration_origin(c)));
  write_file(picture, calibration_picture(c));
  print(board_calibration_text(c, views));
  print(picture + ": corners and residuals\n");
  print(camera_file_use(args.out, args.format, c.camera));
  return 0;
}

int calibrate_from_motion(const CalibrateArguments& args) {
  SourceOptions source = args.images;
  source.path = args.source;
  source.any_camera = true;
  listen_to_signals();
  MotionCalibrationOptions options;
  options.stop = interrupted;
  options.log = [](const std::string& line) { std::printf("%s\n", line.c_str()), std::fflush(stdout); };
  const std::unique_ptr<ImageSource> first = open_source(source);
  std::vector<InputDecision> decisions = first->decisions();
  decisions.erase(std::remove_if(decisions.begin(), decisions.end(),
                                 [](const InputDecision& d) { return d.subject == "camera"; }),
                  decisions.end());
  print_decisions(args.source, decisions);
  if (args.images.fov_deg) options.focal_px = first->camera().pinhole().fx;
  const MotionCalibration c = camera_from_motion([&] { return open_source(source); }, args.source, options);
  if (!c.problem.empty()) throw InputError(args.source, c.problem, c.remedy);
  write_file(args.out, camera_file_text(c.camera, args.format, motion_calibration_origin(c)));
  print(motion_calibration_text(c));
  print(camera_file_use(args.out, args.format, c.camera));
  return 0;
}

int calibrate(const CalibrateArguments& args) {
  check_not_there(args.out, args.force);
  if (args.from_motion) return calibrate_from_motion(args);
  return args.chessboard.empty() && args.charuco.empty() ? calibrate_from_run(args)
                                                         : calibrate_from_board(args);
}

void add_board_options(CLI::App& command, CalibrateArguments* args) {
  CLI::Option* chessboard =
      command.add_option("--chessboard", args->chessboard,
                         "SOURCE shows a chessboard of COLUMNSxROWS inner corners, such as 9x6");
  CLI::Option* charuco = command
                             .add_option("--charuco", args->charuco,
                                         "SOURCE shows a ChArUco board of COLUMNSxROWS squares, such as 7x5")
                             ->excludes(chessboard);
  command
      .add_option("--square", args->square_m,
                  "side of a square of the board, metres (default 1: the camera is the same)")
      ->check(positive_number());
  command.add_option("--marker", args->marker_m, "side of a marker of the ChArUco board, metres")
      ->check(positive_number())
      ->needs(charuco);
  command
      .add_option("--dictionary", args->dictionary,
                  "dictionary of the markers, as in OpenCV: 4x4_50 (default), 6x6_250, ...")
      ->needs(charuco);
  command
      .add_option_function<std::string>(
          "--model", [args](const std::string& name) { args->lens = lens_of_option(name); },
          "lens: plumb_bob, fisheye (Kannala-Brandt), rational, or auto (default: plumb_bob, unless another "
          "has "
          "clearly smaller residuals)")
      ->check(CLI::IsMember({"auto", "plumb_bob", "fisheye", "rational"}));
  CLI::Option* motion =
      command
          .add_flag("--from-motion", args->from_motion,
                    "no board: SOURCE is a recording of any scene by a camera that turns about all its axes")
          ->excludes(chessboard)
          ->excludes(charuco);
  command
      .add_option("--fov", args->images.fov_deg,
                  "view over the longer side, degrees, to start --from-motion at (default: 90)")
      ->check(number_between(1, 179))
      ->needs(motion);
  command.add_option("--every", args->images.every, "use only every N-th image of a video")
      ->check(whole_number(1));
  command.add_option_function<std::string>(
      "--frames", [args](const std::string& text) { set_frame_range(text, &args->images); },
      "use only frames A to B-1 of it, as A:B");
}

}  // namespace

void add_calibrate_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand("calibrate",
                                         "write a camera file: from images of a board or of any scene, or "
                                         "with the lens distortion found by a run");
  auto args = std::make_shared<CalibrateArguments>();
  command
      ->add_option("SOURCE", args->source,
                   "results folder of a finished `edgevo run`; with --chessboard or --charuco, a folder of "
                   "images or a video of the board; with --from-motion, any source")
      ->required();
  command
      ->add_option("-o,--out", args->out,
                   "camera file to write (YAML); from a board also a plot of the residuals (.png)")
      ->required()
      ->check(path_given());
  command->add_option("--camera", args->camera_file,
                      "camera file that the run used (default: the camera in its summary.yaml)");
  command
      ->add_option("--format", args->format,
                   "format of the camera file: ros (default), kalibr, orb_slam or opencv")
      ->check(CLI::IsMember(camera_file_formats()));
  add_board_options(*command, args.get());
  add_force(*command, &args->force);
  command->callback([=] { *action = [=] { return calibrate(*args); }; });
}

}  // namespace edgevo::app
