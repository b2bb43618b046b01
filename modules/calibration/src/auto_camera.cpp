// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/auto_camera.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "edgevo/calibration/camera_from_motion.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/datasets/camera_file.h"

namespace edgevo {
namespace {

// Name of a new, empty file.
std::string temporary_file() {
  std::string path = (std::filesystem::temp_directory_path() / "edgevo_camera_XXXXXX").string();
  const int file = mkstemp(path.data());
  if (file < 0) throw InputError(path, "cannot be created", "set TMPDIR to a folder with room");
  close(file);
  return path;
}

// Focal length that EXIF states, pixels; 0: none.
double focal_length_by_exif(const ImageSource& source) {
  for (const InputDecision& d : source.decisions())
    if (d.subject == "camera" && d.value.rfind("assumed", 0) == 0) return source.camera().pinhole().fx;
  return 0;
}

InputDecision found_decision(const MotionCalibration& c) {
  const double f = c.camera.pinhole().fx;
  const Distortion& d = c.camera.distortion();
  return {"camera", "found, f " + fixed(f, 1) + " px",
          "by the motion over " + std::to_string(c.keyframes) + " keyframes, +- " +
              fixed(100 * c.sigma_f_px / f, 1) + " %; k1 " + fixed(d.k1, 4) + " +- " + fixed(c.sigma_k1, 4) +
              ", k2 " + fixed(d.k2, 4) + " +- " + fixed(c.sigma_k2, 4),
          ""};
}

InputDecision assumed_decision(const MotionCalibration& c, bool by_exif) {
  return {
      "camera", "assumed, f " + fixed(c.camera.pinhole().fx, 0) + " px",
      std::string(by_exif ? "by EXIF" : "90 degrees over the longer side") + "; not observable: " + c.problem,
      "It is a guess: path, map and rotations are off as much as it is. Give --camera FILE or --fov DEGREES, "
      "or " +
          c.remedy + "."};
}

}  // namespace

AutoCamera::AutoCamera(SourceOptions* source, uint64_t seed,
                       const std::function<void(const std::string&)>& log,
                       const std::function<bool()>& stop) {
  const std::string where = source->path;
  if (where.rfind("camera:", 0) == 0)
    throw InputError("--camera auto", "needs a recording; " + where + " cannot be played again",
                     "record it first, or give --fov DEGREES");
  SourceOptions images = *source;
  images.camera_file.clear();
  images.any_camera = true;
  MotionCalibrationOptions options;
  options.focal_px = focal_length_by_exif(*open_source(images));
  options.seed = seed;
  options.stop = stop;
  options.log = log;
  const MotionCalibration c = camera_from_motion([&] { return open_source(images); }, where, options);
  const bool found = c.problem.empty();
  decision_ = found ? found_decision(c) : assumed_decision(c, options.focal_px > 0);
  const std::string text = camera_file_text(c.camera, "ros", decision_.value + ", " + decision_.reason);
  if (found) found_ = text;
  path_ = temporary_file();
  write_file(path_, text);
  source->camera_file = path_;
}

AutoCamera::~AutoCamera() { std::remove(path_.c_str()); }

}  // namespace edgevo
