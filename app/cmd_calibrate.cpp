// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "edgevo/calibration/calibrate_camera.h"
#include "edgevo/calibration/calibration_picture.h"
#include "edgevo/calibration/camera_difference.h"
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

RunCalibration calibration_from(const CalibrateArguments& args) {
  RunCalibration run = read_run_calibration(args.source);
  if (args.camera_file.empty()) return run;
  const Camera camera = read_camera_file(args.camera_file);
  if (camera.width != run.camera.width || camera.height != run.camera.height)
    throw InputError(args.camera_file, "its image size is not that of the run",
                     "give the camera file that the run used");
  constexpr double kSame_px = 0.1;  // summary.yaml has nine digits
  if (const double difference = largest_difference_px(run.camera, camera); difference > kSame_px)
    throw InputError(args.camera_file,
                     "is another camera than that of the run: points differ by up to " +
                         (difference < 1e4 ? fixed(difference, 1) + " px" : "the whole image"),
                     "give the camera file that the run used, or run again with this one");
  run.camera = camera;
  return run;
}

std::string finding_of_k1(const CameraRefinement& c) {
  if (c.sigma == 0) return "k1 was not estimated";
  const std::string basis = std::to_string(c.keyframes) + " keyframes";
  if (c.state == CameraRefinement::State::kInsignificant)
    return "no significant residual distortion (k1 " + fixed(c.estimate, 4) + " +- " + fixed(c.sigma, 4) +
           ", " + basis + ")";
  return "residual k1 " + fixed(c.correction.k1, 4) + " +- " + fixed(c.sigma, 4) +
         " (one standard deviation), from " + basis;
}

std::string finding(const CameraRefinement& c) {
  const CameraRefinement::FocalLength& f = c.focal_length;
  if (c.correction.keeps_lens()) return finding_of_k1(c) + ": the camera stays as it was";
  if (c.correction.focal == 0) return finding_of_k1(c);
  return "focal length " + fixed(100 * c.correction.focal, 1) + " +- " + fixed(100 * f.sigma, 1) +
         " % off the file's, by corners in " + std::to_string(f.windows) + " windows of views; " +
         finding_of_k1(c);
}

void print_lens(const char* name, const Camera& camera) {
  const Distortion d = camera.distortion();
  std::printf("  %-7s %11.4f %11.6f %11.6f %11.6f %11.6f %11.6f\n", name, camera.pinhole().fx, d.k1, d.k2,
              d.p1, d.p2, d.k3);
}

void print_change(const Camera& before, const FoldedCamera& after) {
  std::printf("  %-7s %11s %11s %11s %11s %11s %11s\n", "", "fx", "k1", "k2", "p1", "p2", "k3");
  print_lens("before", before);
  print_lens("after", after.camera);
  std::printf(
      "image points move by up to %.2f px; the new lens model fits both distortions within %.4f px, rms %.4f "
      "px\n",
      after.max_shift_px, after.max_error_px, after.rms_error_px);
}

void print_lens_seen(const CameraRefinement::Lens& l) {
  if (l.keyframes == 0) return;
  std::printf(
      "by the matches, with k2 and focal length free: k1 %.4f +- %.4f, k2 %.4f +- %.4f, focal length %+.1f "
      "+- %.1f %%; not "
      "in the file (edgevo calibrate --from-motion writes all of them)\n",
      l.k1, l.k1_sigma, l.k2, l.k2_sigma, 100 * l.focal, 100 * l.focal_sigma);
}

// Nothing is printed of one that is in the new file.
void print_focal_length_seen(const CameraRefinement& c) {
  constexpr double kSigmas = 3;
  const CameraRefinement::FocalLength& f = c.focal_length;
  if (c.correction.focal == 0 && std::abs(f.estimate) > kSigmas * f.sigma)
    std::printf(
        "by corners, the focal length is %+.1f +- %.1f %% off the file's, which the run has not corrected: "
        "not in "
        "the file (calibrate from a board, --chessboard, or --from-motion)\n",
        100 * f.estimate, 100 * f.sigma);
}

void print_use(const CalibrateArguments& args, const Camera& camera) {
  std::string programs = "ROS";
  if (args.format == "kalibr") programs = "Kalibr";
  if (args.format == "orb_slam") programs = "ORB-SLAM";
  if (args.format == "opencv") programs = "OpenCV";
  if (args.format == "ros" && camera.plumb_bob()) programs = "MRPT, OpenCV and ROS";
  std::printf("%s: a camera file for --camera, %s\n", args.out.c_str(), programs.c_str());
}

int calibrate_from_run(const CalibrateArguments& args) {
  const RunCalibration run = calibration_from(args);
  const FoldedCamera corrected = corrected_camera(run);
  const std::string found = finding(run.refinement);
  write_file(args.out,
             camera_file_text(corrected.camera, args.format, "Self-calibration of edgevo: " + found));
  std::printf("%s: %s\n", run.path.c_str(), found.c_str());
  if (!run.refinement.correction.keeps_lens()) print_change(run.camera, corrected);
  print_focal_length_seen(run.refinement);
  print_lens_seen(run.refinement.lens);
  if (run.refinement.correction.readout_s != 0)
    std::printf(
        "rolling shutter, read-out time %.4f s: camera files cannot hold it; pass it with --set "
        "camera.readout_s=%.4f\n",
        run.refinement.correction.readout_s, run.refinement.correction.readout_s);
  print_use(args, corrected.camera);
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

void print_left_out(const BoardViews& views) {
  if (views.of_other_size.empty()) return;
  constexpr size_t kMaxNames = 5;
  std::string names;
  for (size_t i = 0; i < std::min(kMaxNames, views.of_other_size.size()); ++i)
    names += (i > 0 ? ", " : "") + views.of_other_size[i];
  std::printf("skipped: %zu of %zu images, which are not %dx%d: %s%s\n", views.of_other_size.size(),
              views.of_other_size.size() + size_t(views.images), views.width, views.height, names.c_str(),
              views.of_other_size.size() > kMaxNames ? ", ..." : "");
}

// "residuals by lens: plumb_bob 1.913 px, fisheye 0.104 px, rational 0.231 px"
void print_tried(const std::vector<TriedLens>& tried) {
  std::string text;
  for (const TriedLens& t : tried)
    text += std::string(text.empty() ? "" : ", ") + to_string(t.lens) + " " +
            (std::isnan(t.rms_px) ? "does not fit" : fixed(t.rms_px, 3) + " px");
  std::printf("residuals by lens: %s\n", text.c_str());
}

// Nullopt for "auto".
std::optional<CalibratedLens> lens_of_option(const std::string& name) {
  for (const CalibratedLens lens :
       {CalibratedLens::kPlumbBob, CalibratedLens::kFisheye, CalibratedLens::kRational})
    if (name == to_string(lens)) return lens;
  return std::nullopt;
}

void print_calibration(const CameraCalibration& c, const BoardViews& views) {
  const Pinhole p = c.camera.pinhole();
  print_left_out(views);
  std::printf("board found in %d of %d images; %zu distinct views used, %zu rejected for their residuals\n",
              views.seen, views.images, c.views.size(), c.skipped.size());
  std::printf("fx %.2f fy %.2f +- %.2f px, cx %.2f cy %.2f +- %.2f px (one standard deviation)\n", p.fx, p.fy,
              c.sigma_f_px, p.cx, p.cy, c.sigma_c_px);
  std::string lens;
  for (const auto& [name, value] : coefficients_of(c.camera.model))
    lens += name + " " + fixed(value, 5) + " ";
  std::printf("%s: %sresiduals %.3f px rms\n", to_string(c.camera.model), lens.c_str(), c.rms_px);
  if (c.tried.size() > 1) print_tried(c.tried);
  for (const std::string& what : c.lacking) std::printf("missing: %s\n", what.c_str());
}

int calibrate_from_board(const CalibrateArguments& args) {
  const BoardViews views = views_from(args);
  const CameraCalibration c = calibrate_camera(views, args.source, args.lens);
  const std::string picture = picture_path(args.out);
  write_file(args.out,
             camera_file_text(c.camera, args.format,
                              "Calibrated by edgevo: " + std::to_string(c.views.size()) +
                                  " views of a board, residuals " + fixed(c.rms_px, 3) + " px rms"));
  write_file(picture, calibration_picture(c));
  print_calibration(c, views);
  std::printf("%s: corners and residuals\n", picture.c_str());
  print_use(args, c.camera);
  return 0;
}

// "f 532.9 +- 4.1 px, cx 318.2 cy 254.9 +- 2.0 px, k1 -0.012 +- 0.009, k2 0.001 +- 0.004 (one standard
// deviation)"
void print_motion_calibration(const MotionCalibration& c) {
  const Pinhole p = c.camera.pinhole();
  const Distortion& d = c.camera.distortion();
  std::printf(
      "f %.1f +- %.1f px, cx %.1f cy %.1f +- %.1f px, k1 %.4f +- %.4f, k2 %.4f +- %.4f (one standard "
      "deviation)\n",
      p.fx, c.sigma_f_px, p.cx, p.cy, c.sigma_c_px, d.k1, c.sigma_k1, d.k2, c.sigma_k2);
}

std::string origin_of(const MotionCalibration& c) {
  return "Found by edgevo from the motion over " + std::to_string(c.keyframes) + " keyframes, f to " +
         fixed(c.sigma_f_px, 1) + " px";
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
  write_file(args.out, camera_file_text(c.camera, args.format, origin_of(c)));
  print_motion_calibration(c);
  print_use(args, c.camera);
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
