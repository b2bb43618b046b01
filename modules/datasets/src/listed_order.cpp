// SPDX-License-Identifier: BSD-3-Clause
#include "listed_order.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "edgevo/core/order_statistics.h"
#include "edgevo/core/time_order.h"
#include "edgevo/files/image_names.h"
#include "image_series.h"
#include "name_times.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

bool is_numbered_series(const std::vector<std::string>& images) {
  const std::string pattern = pattern_of(fs::path(images.front()).filename().string());
  if (pattern.find('#') == std::string::npos) return false;
  return std::all_of(images.begin(), images.end(), [&](const std::string& image) {
    return pattern_of(fs::path(image).filename().string()) == pattern;
  });
}

std::optional<InputDecision> falling_names(const std::vector<std::string>& images) {
  if (!is_numbered_series(images)) return std::nullopt;
  size_t falls = 0, first = 0;
  for (size_t i = 1; i < images.size(); ++i)
    if (natural_less(images[i], images[i - 1]) && falls++ == 0) first = i;
  if (falls == 0) return std::nullopt;
  return InputDecision{"order", "as listed, not by the names of the images",
                       std::to_string(falls) + " name(s) come before that of the image before, first " +
                           fs::path(images[first]).filename().string(),
                       "unless the images were numbered so on purpose, sort the list"};
}

// Times in names that do not run as those that are listed: a clock that drifts or is offset does.
std::optional<InputDecision> other_times(const std::vector<std::string>& images,
                                         const std::vector<Timestamp>& times) {
  constexpr double kShare = 0.5;     // of a step
  constexpr size_t kMaxByClock = 2;  // more than a clock that was set
  std::vector<std::string> stems;
  for (const std::string& image : images) stems.push_back(fs::path(image).stem().string());
  const auto named = times_of_names(stems, "");
  if (!named) return std::nullopt;
  std::vector<double> steps;
  for (size_t i = 1; i < times.size(); ++i)
    steps.push_back(std::abs(seconds_between(times[i - 1], times[i])));
  const double tolerance = kShare * median(steps);
  size_t differ = 0, first = 0;
  for (size_t i = 1; i < times.size(); ++i) {
    const double there = seconds_between(named->times[i - 1], named->times[i]);
    if (std::abs(there - seconds_between(times[i - 1], times[i])) > tolerance && differ++ == 0) first = i;
  }
  if (differ <= kMaxByClock) return std::nullopt;
  return InputDecision{
      "order", "times as listed, not those in the names of the images",
      std::to_string(differ) + " steps differ, first before " + fs::path(images[first]).filename().string(),
      "the list may not belong to these images, or not in this order; check it"};
}

}  // namespace

void doubt_listed_order(const std::vector<std::string>& images, const std::vector<Timestamp>& times,
                        std::vector<InputDecision>* decisions) {
  if (images.size() < 3 || images.size() != times.size()) return;
  auto found = falling_names(images);
  if (!found) found = other_times(images, fill_missing(times));
  if (found) decisions->push_back(std::move(*found));
}

}  // namespace edgevo
