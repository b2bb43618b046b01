// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/sequence_output/rawlog_output.h"

#include <filesystem>

#include "edgevo/core/output_file.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/rawlog_import.h"
#include "edgevo/mrpt_bridge/rawlog_writer.h"

namespace edgevo {

namespace fs = std::filesystem;

bool names_rawlog(const std::string& path) { return fs::path(path).extension() == ".rawlog"; }

void check_sequence_output(const std::string& source, const std::string& out, bool force) {
  check_apart(source, out);
  if (!names_rawlog(out)) return check_folder_is_ours(out, {}, force);
  const std::string images = rawlog_stem(out) + "_Images";
  check_apart(source, images);
  check_not_there(out, force);
  check_folder_is_ours(images, {}, force);
}

int write_rawlog(ImageSource& source, const std::string& rawlog, const std::string& ground_truth_tum,
                 const std::function<void(int)>& on_frame_done) {
  if (fs::path(rawlog).has_parent_path()) make_output_folder(fs::path(rawlog).parent_path().string());
  if (!ground_truth_tum.empty()) write_file(rawlog_stem(rawlog) + "_groundtruth_tum.txt", ground_truth_tum);
  return import_rawlog(source, rawlog, on_frame_done);
}

std::string describe_rawlog(const std::string& rawlog, int frames, bool has_ground_truth,
                            const Camera& camera) {
  const double error = closest_mrpt(camera).max_error_px;
  return rawlog + ": " + std::to_string(frames) + " frames, images in " + rawlog_stem(rawlog) + "_Images" +
         (has_ground_truth ? ", ground truth next to it" : "") +
         (error > 0 ? "; for MRPT the lens (" + std::string(to_string(camera.model)) +
                          ") is the closest kannala_brandt, at most " + fixed(error, 2) + " px off"
                    : "");
}

}  // namespace edgevo
