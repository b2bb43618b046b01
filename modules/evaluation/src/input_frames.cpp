// SPDX-License-Identifier: BSD-3-Clause
// Search for the list of input frames.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

#include "edgevo/core/error.h"
#include "edgevo/evaluation/time_matching.h"
#include "time_steps.h"

namespace edgevo {
namespace {

std::string sibling_path(const std::string& path, const char* name) {
  return (std::filesystem::path(path).parent_path() / name).string();
}

// Column `wanted` of a line of comma-separated values; empty if there are fewer.
std::string_view csv_field(std::string_view line, int wanted) {
  for (int column = 0; column < wanted; ++column) {
    const size_t comma = line.find(',');
    if (comma == std::string_view::npos) return {};
    line.remove_prefix(comma + 1);
  }
  return line.substr(0, line.find(','));
}

std::string_view trimmed(std::string_view s) {
  const size_t begin = s.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return s.substr(begin, s.find_last_not_of(" \t\r") - begin + 1);
}

int time_column(std::string_view header, const std::string& where) {
  const auto columns = 1 + std::count(header.begin(), header.end(), ',');
  for (int c = 0; c < columns; ++c) {
    const std::string_view name = trimmed(csv_field(header, c));
    if (name == "time" || name == "time_s") return c;
  }
  throw InputError(where, "has no column named time",
                   "give a frames.csv that edgevo run wrote, or --frames-total N");
}

void add_time(std::string_view text, const std::string& where, std::vector<Timestamp>* times) {
  Timestamp t;
  if (!parse_seconds(trimmed(text), &t))
    throw InputError(where, "the time is not a number of seconds",
                     "correct the line, or give --frames-total N");
  if (!times->empty() && t <= times->back())
    throw InputError(where, "time " + to_string(t) + " does not come after the one before",
                     "correct the line, or give --frames-total N");
  times->push_back(t);
}

// Times from a file with one frame a line; with `is_csv`, under a header that names the column.
InputFrames read_times(const std::string& path, bool is_csv) {
  std::ifstream in(path);
  if (!in) throw InputError(path, "cannot be read", "check its permissions, or give --frames-total N");
  InputFrames frames{{}, path};
  std::string line;
  int column = 0;
  bool header_is_next = is_csv;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string where = path + ":" + std::to_string(number);
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    if (std::exchange(header_is_next, false))
      column = time_column(text, where);
    else
      add_time(csv_field(text, column), where, &frames.times);
  }
  if (frames.times.empty()) throw InputError(path, "lists no frame", "remove it, or give --frames-total N");
  return frames;
}

std::vector<Timestamp> evenly(Timestamp first, int64_t step, int count) {
  std::vector<Timestamp> times;
  for (int i = 0; i < count; ++i) times.push_back({first.ticks + i * step});
  return times;
}

bool are_frames_of(const std::vector<Timestamp>& estimate, const std::vector<Timestamp>& truth) {
  const int64_t step_est = median_step_ticks(estimate), step_gt = median_step_ticks(truth);
  if (2 * step_est > 3 * step_gt || 3 * step_est < 2 * step_gt) return false;
  const auto coincide = std::count_if(estimate.begin(), estimate.end(), [&](Timestamp t) {
    return 10 * std::abs(t.ticks - truth[size_t(nearest_index(truth, t))].ticks) <= step_gt;
  });
  return 2 * size_t(coincide) > estimate.size();
}

}  // namespace

InputFrames find_input_frames(const Trajectory& estimate, const Trajectory& ground_truth,
                              std::optional<int> frames_total) {
  const std::vector<Timestamp> est = times_of(estimate), gt = times_of(ground_truth);
  const int64_t step = std::max<int64_t>(median_step_ticks(est), 1);
  const int64_t in_span = (est.back().ticks - est.front().ticks + step / 2) / step + 1;
  if (frames_total) {
    if (*frames_total < int(est.size()))
      throw InputError("--frames-total " + std::to_string(*frames_total),
                       estimate.path + " holds " + std::to_string(est.size()) + " poses",
                       "give the number of input images");
    return {evenly(est.front(), step, *frames_total), "--frames-total"};
  }
  const bool has_times = estimate.format == TrajectoryFormat::kTum;
  const std::string csv = sibling_path(estimate.path, "frames.csv");
  if (has_times && std::filesystem::is_regular_file(csv)) return read_times(csv, true);
  const std::string list = sibling_path(ground_truth.path, "times.txt");
  if (has_times && std::filesystem::is_regular_file(list)) return read_times(list, false);
  if (are_frames_of(est, gt)) return {gt, "lines of the ground truth"};
  const int64_t limited = std::min<int64_t>(in_span, 10'000'000);
  return {evenly(est.front(), step, int(limited)), "span of the trajectory at its median step"};
}

}  // namespace edgevo
