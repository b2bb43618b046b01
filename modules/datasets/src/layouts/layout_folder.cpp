// SPDX-License-Identifier: BSD-3-Clause
// A plain folder of images: the camera comes from the user, times from the names or from a rate.
#include <filesystem>

#include "assumed_camera.h"
#include "image_series.h"
#include "layout.h"
#include "name_times.h"
#include "rate.h"
#include "wrapped_order.h"

namespace edgevo {
namespace {

// Times by a rate, which is a decision if nobody stated it.
void set_times_by_rate(const SourceOptions& options, Sequence* sequence) {
  const Rate rate = choose_rate(options.fps, 0);
  for (size_t i = 0; i < sequence->images.size(); ++i) sequence->times.push_back(rate.time(int64_t(i)));
  if (rate.decision)
    sequence->decisions.push_back(*rate.decision);
  else
    sequence->details.emplace_back("times", rate.says);
}

}  // namespace

Sequence read_image_folder(const SourceOptions& options) {
  Sequence sequence;
  sequence.kind = "folder of images";
  sequence.ordered_by_names = true;
  sequence.images = list_images(options.path, options, &sequence.decisions);
  sequence.camera = choose_or_assume_camera(options, "", seen_images(sequence.images), &sequence.decisions);
  std::vector<std::string> stems;
  for (const std::string& image : sequence.images)
    stems.push_back(std::filesystem::path(image).stem().string());
  auto named = times_of_names(stems, options.time_unit);
  if (named) {
    sequence.times = std::move(named->times);
    order_by_times(named->period_s, &sequence);
  } else {
    order_by_counter(&sequence);
  }
  if (named && options.fps == 0) {
    sequence.decisions.push_back(named->decision);
  } else {
    sequence.times.clear();
    set_times_by_rate(options, &sequence);
  }
  return sequence;
}

}  // namespace edgevo
