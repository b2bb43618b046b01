// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/results/rawlog_output.h"
#include "edgevo/simulation/folder_export.h"
#include "edgevo/simulation/overlaid_source.h"
#include "option_checks.h"
#include "progress.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

struct OverlayCommand {
  SourceOptions source;
  OverlayOptions overlay;
  std::string out;
  bool force = false;
};

std::string note(const OverlayOptions& o) {
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

int overlay(const OverlayCommand& options) {
  if (names_rawlog(options.out))
    throw InputError(options.out, "masks do not fit into a rawlog", "name a folder");
  check_sequence_output(options.source.path, options.out, options.force);
  auto opened = open_source_with_notices(options.source);
  const std::string truth = ground_truth_tum(options.source, *opened);
  OverlaidSource source(std::move(opened), options.overlay);
  clear_sequence(options.out);
  FolderWriter writer(options.out, source.camera());
  const bool moves =
      options.overlay.vehicle_px > 0 || options.overlay.crossing_px > 0 || !options.overlay.passing.empty();
  int count = 0;
  {
    Progress progress("pasting", source.size());
    while (const std::optional<Frame> frame = source.next()) {
      writer.add(*frame);
      if (moves) writer.add_mask(*frame, source.moving_mask());
      progress.update(++count);
    }
  }
  if (const GrayImage own = source.own_part_mask(); !own.empty()) writer.add_fixed_mask(own);
  writer.finish(source.ground_truth(truth), note(options.overlay));
  std::printf("%s: %d frames\n", options.out.c_str(), count);
  if (options.overlay.standing > 0 && options.overlay.stop_at >= count)
    throw InputError("--stop-at " + std::to_string(options.overlay.stop_at),
                     "is beyond the source's " + std::to_string(count) + " frames: the camera never stands",
                     "give 0 to " + std::to_string(count - 1));
  return 0;
}

}  // namespace

void add_overlay_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "overlay",
      "write a copy of a source with foreign bodies pasted over it, and masks of them, as a folder");
  auto options = std::make_shared<OverlayCommand>();
  add_source_options(*command, &options->source);
  std::string kinds;
  for (const std::string& kind : own_part_kinds()) kinds += (kinds.empty() ? "" : ", ") + kind;
  command->add_option("-o,--out", options->out, "folder to write")->required()->check(path_given());
  OverlayOptions& o = options->overlay;
  CLI::Option* part =
      command->add_option("--own-part", o.own_part, "part that is fixed to the camera: " + kinds);
  command
      ->add_option("--part-share", o.part_share,
                   "its share of the image (default: 0.1; bow 0.15, bonnet 0.2, dashboard 0.3)")
      ->check(number_between(0.01, 0.5))
      ->needs(part);
  command
      ->add_option("--vehicle-ahead", o.vehicle_px,
                   "lorry ahead, of this width in pixels at its nearest, in an image 1241 wide")
      ->check(number_between(20, 1241));
  command->add_option("--traffic", o.passing, "lorries on the next lane: oncoming or overtaking");
  CLI::Option* standing =
      command->add_option("--standing", o.standing, "frames that the camera stands, with noise")
          ->check(whole_number(1, 100000));
  command->add_option("--stop-at", o.stop_at, "frame that is repeated then, counted from the first")
      ->check(whole_number(0))
      ->capture_default_str()
      ->needs(standing);
  command
      ->add_option("--crossing", o.crossing_px,
                   "bus that crosses meanwhile, of this length in pixels in an image 1241 wide")
      ->check(number_between(20, 5000));
  command->add_option("--seed", o.seed, "seed of textures and noise")
      ->check(whole_number(0, std::numeric_limits<uint64_t>::max()))
      ->capture_default_str();
  add_force(*command, &options->force);
  command->callback([=] { *action = [=] { return overlay(*options); }; });
}

}  // namespace edgevo::app
