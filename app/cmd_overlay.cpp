// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "commands.h"
#include "edgevo/sequence_output/derived_sequence.h"
#include "option_checks.h"
#include "sequence_host.h"
#include "source_options.h"

namespace edgevo::app {

void add_overlay_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "overlay",
      "write a copy of a source with foreign bodies pasted over it, and masks of them, as a folder");
  auto options = std::make_shared<OverlayRequest>();
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
  command->callback([=] { *action = [=] { return write_overlaid(*options, sequence_host()), 0; }; });
}

}  // namespace edgevo::app
