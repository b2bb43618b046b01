// SPDX-License-Identifier: BSD-3-Clause
#include "run_description.h"

#include <algorithm>
#include <cstdio>

#include "edgevo/core/closest_lens.h"
#include "edgevo/core/output_file.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/describe.h"

namespace edgevo {

RunInfo describe_run(const RunRequest& request, const ImageSource& source, const OdometryOptions& odometry) {
  RunParams params = request.params;
  RunInfo info;
  info.command_line = request.command_line;
  info.source_kind = source.kind();
  info.source_path = request.source.path;
  info.ground_truth_path = source.ground_truth_path();
  info.camera = source.camera();
  info.input = source.decisions();
  info.working_pinhole = odometry.working_pinhole;
  info.params_yaml = write_params([&](ParamVisitor& v) { params.visit(v); });
  info.notes = {{"seed", std::to_string(request.seed)},
                {"mode", request.realtime ? "realtime, two threads" : "synchronous"}};
  if (request.outputs.forget)
    info.notes.emplace_back(kForgottenNote, "written by `edgevo finish` from what --forget has left on disk");
  if (request.outputs.mcap == McapContent::kImages) info.notes.emplace_back(kMcapNote, kMcapWithImages);
  for (const auto& notice : source_notices(source)) info.notes.push_back(notice);
  if (!info.camera.plumb_bob())
    info.notes.emplace_back("playback_camera",
                            "kannala_brandt, at most " +
                                fixed(closest_kannala_brandt(info.camera).max_error_px, 3) +
                                " px from the lens");
  return info;
}

void note_found_camera(const AutoCamera& camera, RunInfo* info) {
  info->camera_file = camera.found();
  auto& input = info->input;
  input.erase(std::remove_if(input.begin(), input.end(), [](const auto& d) { return d.subject == "camera"; }),
              input.end());
  input.push_back(camera.decision());
}

std::string statement_of(const PlaceCounts& places) {
  if (places.stated + places.beyond_drift + places.ambiguous + places.skipped == 0) return "";
  std::string text = std::to_string(places.stated) + " keyframes at places seen before, of " +
                     std::to_string(places.queries) + " looked up";
  if (places.beyond_drift > 0)
    text += "; " + std::to_string(places.beyond_drift) + " matches rejected, too far from the path";
  if (places.ambiguous > 0)
    text += "; " + std::to_string(places.ambiguous) + " rejected, places that look alike";
  if (places.skipped > 0) text += "; " + std::to_string(places.skipped) + " skipped for lack of time";
  return text;
}

void note_end(const RunResult& result, bool stopped, const std::optional<SE3>& T_vehicle_cam, RunInfo* info) {
  info->interrupted = result.broken || stopped;
  if (const std::string places = statement_of(result.places); !places.empty())
    info->notes.emplace_back("places", places);
  if (result.gyro.model && result.gyro.model->is_observed()) {
    const auto mount = T_vehicle_cam ? std::make_optional(camera_mount(*T_vehicle_cam)) : std::nullopt;
    if (info->camera_file.empty()) info->camera_file = camera_yaml(info->camera, "", mount);
    info->camera_file += gyro_yaml(*result.gyro.model);
  }
  if (!result.gyro.statement.empty()) info->notes.emplace_back("gyro", result.gyro.statement);
  if (result.skipped == 0) return;
  info->notes.emplace_back("left_out", std::to_string(result.skipped) +
                                           " frame(s) whose images or times could not be used; the first: " +
                                           result.first_skipped);
}

void note_mask(const EgoMaskImage& own, RunInfo* info) {
  if (!own) return;
  info->ego_mask = {own->width(), own->height(), {}};
  int masked = 0;
  for (int y = 0; y < own->height(); ++y)
    for (int x = 0; x < own->width(); ++x) {
      info->ego_mask.pixels.push_back(own->at(x, y) ? 0 : 255);
      masked += own->at(x, y) != 0;
    }
  char text[80];
  std::snprintf(text, sizeof text, "%.0f %% of the image is fixed to the camera and left out: mask.png",
                100.0 * masked / double(info->ego_mask.pixels.size()));
  info->notes.emplace_back("mask", text);
}

}  // namespace edgevo
