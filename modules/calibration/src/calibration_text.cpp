// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/calibration_text.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/formatted.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

std::string finding_of_k1(const CameraPosterior& c) {
  const double sigma = c.given.sigma_of(CameraNumber::kK1);
  if (sigma == 0) return "k1 was not estimated";
  const std::string basis = std::to_string(c.given.keyframes) + " keyframes";
  if (c.applied.k1 == 0)
    return "no significant residual distortion (k1 " + fixed(c.given.mean_of(CameraNumber::kK1), 4) + " +- " +
           fixed(sigma, 4) + ", " + basis + ")";
  return "residual k1 " + fixed(c.applied.k1, 4) + " +- " + fixed(sigma, 4) +
         " (one standard deviation), from " + basis;
}

std::string lens_line(const char* name, const Camera& camera) {
  const Distortion d = camera.distortion();
  return formatted("  %-7s %11.4f %11.6f %11.6f %11.6f %11.6f %11.6f\n", name, camera.pinhole().fx, d.k1,
                   d.k2, d.p1, d.p2, d.k3);
}

std::string change_text(const Camera& before, const FoldedCamera& after) {
  return formatted("  %-7s %11s %11s %11s %11s %11s %11s\n", "", "fx", "k1", "k2", "p1", "p2", "k3") +
         lens_line("before", before) + lens_line("after", after.camera) +
         formatted(
             "image points move by up to %.2f px; the new lens model fits both distortions within %.4f px, "
             "rms %.4f px\n",
             after.max_shift_px, after.max_error_px, after.rms_error_px);
}

std::string lens_seen(const CameraPosterior& c) {
  const CameraGaussian& lens = c.whole;
  if (lens.keyframes == 0) return {};
  return formatted(
      "by corners and matches, with k2 and focal length free: k1 %.4f +- %.4f, k2 %.4f +- %.4f, focal length "
      "%+.1f +- %.1f %%; %s not in the file (edgevo calibrate --from-motion writes all of them)\n",
      lens.mean_of(CameraNumber::kK1), lens.sigma_of(CameraNumber::kK1), lens.mean_of(CameraNumber::kK2),
      lens.sigma_of(CameraNumber::kK2), 100 * lens.mean_of(CameraNumber::kFocal), 100 * c.focal_sigma(),
      c.applied.focal == 0 ? "these are" : "k2 is");
}

// Nothing is printed of one that is in the new file.
std::string focal_length_seen(const CameraPosterior& c) {
  if (c.applied.focal == 0 && std::abs(c.corners.focal) > kImprobable * c.corners.sigma)
    return formatted(
        "by corners, the focal length is %+.1f +- %.1f %% off the file's, which the run has not corrected: "
        "not in "
        "the file (calibrate from a board, --chessboard, or --from-motion)\n",
        100 * c.corners.focal, 100 * c.corners.sigma);
  return {};
}

std::string skipped_images(const BoardViews& views) {
  if (views.of_other_size.empty()) return {};
  constexpr size_t kMaxNames = 5;
  std::string names;
  for (size_t i = 0; i < std::min(kMaxNames, views.of_other_size.size()); ++i)
    names += (i > 0 ? ", " : "") + views.of_other_size[i];
  return formatted("skipped: %zu of %zu images, which are not %dx%d: %s%s\n", views.of_other_size.size(),
                   views.of_other_size.size() + size_t(views.images), views.width, views.height,
                   names.c_str(), views.of_other_size.size() > kMaxNames ? ", ..." : "");
}

// "residuals by lens: plumb_bob 1.913 px, fisheye 0.104 px, rational 0.231 px"
std::string tried_lenses(const std::vector<TriedLens>& tried) {
  std::string text;
  for (const TriedLens& t : tried)
    text += std::string(text.empty() ? "" : ", ") + to_string(t.lens) + " " +
            (std::isnan(t.rms_px) ? "does not fit" : fixed(t.rms_px, 3) + " px");
  return "residuals by lens: " + text + "\n";
}

}  // namespace

std::string finding(const CameraPosterior& c) {
  if (c.applied.keeps_lens()) return finding_of_k1(c) + ": the camera stays as it was";
  if (c.applied.focal == 0) return finding_of_k1(c);
  return "focal length " + fixed(100 * c.applied.focal, 1) + " +- " + fixed(100 * c.focal_sigma(), 1) +
         " % off the file's, by " +
         (c.corners.windows > 0 ? "corners in " + std::to_string(c.corners.windows) + " windows of views and "
                                : std::string()) +
         "the matches of " + std::to_string(c.whole.keyframes) + " keyframes; " + finding_of_k1(c);
}

std::string run_calibration_text(const RunCalibration& run, const FoldedCamera& corrected) {
  const CameraPosterior& c = run.refinement;
  std::string text = run.path + ": " + finding(c) + "\n";
  if (!c.applied.keeps_lens()) text += change_text(run.camera, corrected);
  text += focal_length_seen(c) + lens_seen(c);
  if (c.applied.readout_s != 0)
    text += formatted(
        "rolling shutter, read-out time %.4f s: camera files cannot hold it; pass it with --set "
        "camera.readout_s=%.4f\n",
        c.applied.readout_s, c.applied.readout_s);
  return text;
}

std::string board_calibration_text(const CameraCalibration& c, const BoardViews& views) {
  const Pinhole p = c.camera.pinhole();
  std::string text = skipped_images(views);
  text +=
      formatted("board found in %d of %d images; %zu distinct views used, %zu rejected for their residuals\n",
                views.seen, views.images, c.views.size(), c.skipped.size());
  text += formatted("fx %.2f fy %.2f +- %.2f px, cx %.2f cy %.2f +- %.2f px (one standard deviation)\n", p.fx,
                    p.fy, c.sigma_f_px, p.cx, p.cy, c.sigma_c_px);
  std::string lens;
  for (const auto& [name, value] : coefficients_of(c.camera.model))
    lens += name + " " + fixed(value, 5) + " ";
  text += formatted("%s: %sresiduals %.3f px rms\n", to_string(c.camera.model), lens.c_str(), c.rms_px);
  if (c.tried.size() > 1) text += tried_lenses(c.tried);
  for (const std::string& what : c.lacking) text += "missing: " + what + "\n";
  return text;
}

std::string board_calibration_origin(const CameraCalibration& c) {
  return "Calibrated by edgevo: " + std::to_string(c.views.size()) + " views of a board, residuals " +
         fixed(c.rms_px, 3) + " px rms";
}

// "f 532.9 +- 4.1 px, cx 318.2 cy 254.9 +- 2.0 px, k1 -0.012 +- 0.009, k2 0.001 +- 0.004 (one standard
// deviation)"
std::string motion_calibration_text(const MotionCalibration& c) {
  const Pinhole p = c.camera.pinhole();
  const Distortion& d = c.camera.distortion();
  return formatted(
      "f %.1f +- %.1f px, cx %.1f cy %.1f +- %.1f px, k1 %.4f +- %.4f, k2 %.4f +- %.4f (one standard "
      "deviation)\n",
      p.fx, c.sigma_f_px, p.cx, p.cy, c.sigma_c_px, d.k1, c.sigma_k1, d.k2, c.sigma_k2);
}

std::string motion_calibration_origin(const MotionCalibration& c) {
  return "Found by edgevo from the motion over " + std::to_string(c.keyframes) + " keyframes, f to " +
         fixed(c.sigma_f_px, 1) + " px";
}

std::string camera_file_use(const std::string& path, const std::string& format, const Camera& camera) {
  std::string programs = "ROS";
  if (format == "kalibr") programs = "Kalibr";
  if (format == "orb_slam") programs = "ORB-SLAM";
  if (format == "opencv") programs = "OpenCV";
  if (format == "ros" && camera.plumb_bob()) programs = "MRPT, OpenCV and ROS";
  return path + ": a camera file for --camera, " + programs + "\n";
}

}  // namespace edgevo
