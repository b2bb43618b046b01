// SPDX-License-Identifier: BSD-3-Clause
// A plain folder of images: the camera comes from the user, times from the names or from a rate.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>

#include "assumed_camera.h"
#include "layout.h"
#include "rate.h"
#include "text_file.h"

namespace edgevo {
namespace {

bool all_digits(const std::string& text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

// "1403636579763555584" is nanoseconds since the epoch, "1305031102.175304" seconds; "000017" only counts.
std::optional<Timestamp> time_from_name(const std::string& stem) {
  constexpr size_t kNanosecondDigits = 16;  // from 1970-01-12 on; shorter numbers are counters
  Timestamp t;
  if (all_digits(stem) && stem.size() >= kNanosecondDigits && stem.size() <= 18)
    return parse_nanoseconds(stem, stem);
  if (all_digits(stem) && stem.size() == 19 && stem < "9223372036854775000")
    return parse_nanoseconds(stem, stem);
  const bool decimal =
      stem.find('.') != std::string::npos && std::isdigit(static_cast<unsigned char>(stem[0]));
  if (decimal && parse_seconds(stem, &t)) return t;
  return std::nullopt;
}

std::vector<Timestamp> times_from_names(const std::vector<std::string>& images) {
  std::vector<Timestamp> times;
  for (const std::string& image : images) {
    const auto t = time_from_name(std::filesystem::path(image).stem().string());
    if (!t) return {};
    times.push_back(*t);
  }
  return times;
}

}  // namespace

Sequence read_image_folder(const SourceOptions& options) {
  Sequence sequence;
  sequence.kind = "folder of images";
  sequence.images = list_images(options.path);
  sequence.camera = choose_or_assume_camera(options, "", {sequence.images.front()}, &sequence.details);
  if (options.fps == 0) sequence.times = times_from_names(sequence.images);
  if (!sequence.times.empty()) {
    sequence.details.emplace_back("times", "from the names of the images");
    return sequence;
  }
  const Rate rate = choose_rate(options.fps, 0);
  for (size_t i = 0; i < sequence.images.size(); ++i) sequence.times.push_back(rate.time(int64_t(i)));
  sequence.details.emplace_back("times", rate.says);
  return sequence;
}

}  // namespace edgevo
