// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/sequence_output/derived_sequence.h"

#include "edgevo/core/error.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/sequence_output/rawlog_output.h"
#include "edgevo/simulation/folder_export.h"
#include "edgevo/simulation/overlaid_source.h"
#include "edgevo/simulation/relit_source.h"

namespace edgevo {
namespace {

void check_rawlog_output(const ImportRequest& args) {
  if (!names_rawlog(args.out))
    throw InputError(args.out, "does not end in .rawlog",
                     "name the output OUT.rawlog, so that the MRPT tools recognise it");
  check_sequence_output(args.source.path, args.out, args.force);
}

int write_relit_folder(RelitSource& source, const RelightRequest& options, const std::string& truth,
                       const ShowFramesDone& progress) {
  clear_sequence(options.out);
  const Camera& camera = source.camera();
  FolderWriter writer(options.out, camera, camera.plumb_bob() ? "" : camera_yaml(camera, ""));
  int count = 0;
  while (const std::optional<Frame> frame = source.next()) {
    writer.add(*frame);
    progress(++count);
  }
  writer.add_gyro(source.gyro_readings());
  writer.finish(
      truth,
      "# Relit sequence\n\nThe images of another sequence under changed light (`edgevo relight --kind " +
          options.kind + " --seed " + std::to_string(options.seed) +
          "`); names, times, calibration, gyro and ground truth are the source's. Its licence holds for "
          "these "
          "images, too.\n");
  return count;
}

std::string overlay_note(const OverlayOptions& o) {
  std::string options;
  if (!o.own_part.empty()) options += " --own-part " + o.own_part;
  if (o.part_share > 0) options += " --part-share " + std::to_string(o.part_share);
  if (o.vehicle_px > 0) options += " --vehicle-ahead " + std::to_string(int(o.vehicle_px));
  if (!o.passing.empty()) options += " --traffic " + o.passing;
  if (o.standing > 0)
    options += " --standing " + std::to_string(o.standing) + " --stop-at " + std::to_string(o.stop_at);
  if (o.crossing_px > 0) options += " --crossing " + std::to_string(int(o.crossing_px));
  return "# Sequence with foreign bodies\n\nBodies pasted over the images of another sequence (`edgevo "
         "overlay" +
         options + " --seed " + std::to_string(o.seed) +
         "`). `mask.png`: black on the part that is fixed to the camera; `masks/`: black on bodies that move "
         "by "
         "themselves. The licence of the source holds for these images, too.\n";
}

}  // namespace

void write_imported(const ImportRequest& request, const SequenceHost& host) {
  check_rawlog_output(request);
  const auto source = host.open(request.source);
  const std::string truth = ground_truth_tum(request.source, *source);
  int count = 0;
  {
    const ShowFramesDone progress = host.progress("importing", source->size());
    count = write_rawlog(*source, request.out, truth, progress);
  }
  host.print(describe_rawlog(request.out, count, !truth.empty(), source->camera()));
}

void write_relit(const RelightRequest& request, const SequenceHost& host) {
  check_sequence_output(request.source.path, request.out, request.force);
  const Relight effect(request.kind, request.seed);
  auto opened = host.open(request.source);
  const std::string truth = ground_truth_tum(request.source, *opened);
  RelitSource source(std::move(opened), effect);
  int count = 0;
  {
    const ShowFramesDone progress = host.progress("relighting", source.size());
    count = names_rawlog(request.out) ? write_rawlog(source, request.out, truth, progress)
                                      : write_relit_folder(source, request, truth, progress);
  }
  host.print(request.out + ": " + std::to_string(count) + " frames, " + request.kind);
}

void write_overlaid(const OverlayRequest& request, const SequenceHost& host) {
  if (names_rawlog(request.out))
    throw InputError(request.out, "masks do not fit into a rawlog", "name a folder");
  check_sequence_output(request.source.path, request.out, request.force);
  auto opened = host.open(request.source);
  const std::string truth = ground_truth_tum(request.source, *opened);
  OverlaidSource source(std::move(opened), request.overlay);
  clear_sequence(request.out);
  FolderWriter writer(request.out, source.camera());
  const bool moves =
      request.overlay.vehicle_px > 0 || request.overlay.crossing_px > 0 || !request.overlay.passing.empty();
  int count = 0;
  {
    const ShowFramesDone progress = host.progress("pasting", source.size());
    while (const std::optional<Frame> frame = source.next()) {
      writer.add(*frame);
      if (moves) writer.add_mask(*frame, source.moving_mask());
      progress(++count);
    }
  }
  if (const GrayImage own = source.own_part_mask(); !own.empty()) writer.add_fixed_mask(own);
  // A camera that is made to stand turns otherwise than its gyro.
  if (request.overlay.standing == 0) writer.add_gyro(source.gyro_readings());
  writer.finish(source.ground_truth(truth), overlay_note(request.overlay));
  host.print(request.out + ": " + std::to_string(count) + " frames");
  if (request.overlay.standing > 0 && request.overlay.stop_at >= count)
    throw InputError("--stop-at " + std::to_string(request.overlay.stop_at),
                     "is beyond the source's " + std::to_string(count) + " frames: the camera never stands",
                     "give 0 to " + std::to_string(count - 1));
}

}  // namespace edgevo
