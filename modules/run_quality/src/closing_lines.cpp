// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/closing_lines.h"

#include <algorithm>

#include "edgevo/core/formatted.h"
#include "edgevo/run_quality/doubtful_intervals.h"
#include "edgevo/run_quality/guessed_places.h"
#include "edgevo/run_quality/run_statistics.h"
#include "edgevo/run_quality/run_warnings.h"
#include "edgevo/run_quality/scale_faults.h"

namespace edgevo {

namespace {

// The longest intervals, in time order: what a console has room for.
void add_doubtful(const Run& run, std::vector<ClosingLine>* lines) {
  constexpr size_t kShown = 5;
  const std::vector<DoubtfulInterval> all = doubtful_intervals(run);
  const std::vector<DoubtfulInterval> shown = longest(all, kShown);
  for (const DoubtfulInterval& interval : shown)
    lines->push_back({"NOT TO BE TRUSTED: " + to_string(interval), true});
  if (shown.size() < all.size())
    lines->push_back(
        {formatted("and %zu shorter intervals, listed in summary.yaml", all.size() - shown.size()), true});
  for (const std::string& line : uncertain_in_words(run))
    lines->push_back({"NOT TO BE TRUSTED: " + line, true});
}

// A warning if they are a quarter of all.
void add_without_pose(const Run& run, std::vector<ClosingLine>* lines) {
  const FramesWithoutPose lacking = frames_without_pose(run);
  if (!lacking.reason.empty())
    lines->push_back({formatted("%d frames have no pose; mostly: ", lacking.frames) + lacking.reason,
                      4 * size_t(lacking.frames) >= run.frames.size()});
}

// What the exit code says, too.
std::string problem_of(const RunCounts& n, const std::string& what) {
  if (n.mostly_failed()) return "tracking failed for most of " + what;
  const std::string of = " of " + std::to_string(n.with_pose) + " poses of " + what;
  if (n.is_largely_doubtful()) return std::to_string(n.doubtful_poses()) + of + " are doubtful";
  return std::to_string(n.doubtful_poses() + n.guessed) + of + " are doubtful or in a place that is a guess";
}

std::string reason_of(const Run& run, const RunCounts& n) {
  if (n.with_pose > 0 && n.guessed > n.doubtful_poses()) return "nothing links them to what was before";
  const std::string reason = commonest_doubt(run);
  return reason.empty() ? "the images ended before there was a map" : reason;
}

// Decided by the rest of the run, so that who reads it should be able to look.
void add_mistaken(const Run& run, std::vector<ClosingLine>* lines) {
  const auto mistaken = std::count_if(run.constraints.begin(), run.constraints.end(),
                                      [](const ConstraintRecord& c) { return !c.holds; });
  if (mistaken > 0)
    lines->push_back(
        {formatted("%td of %zu links between views before and after a doubt contradict the rest "
                   "and do not count (graph.csv)",
                   mistaken, run.constraints.size())});
}

}  // namespace

std::vector<ClosingLine> closing_lines(const Run& run, const std::string& out, bool include_doubtful) {
  const RunCounts n = count(run);
  std::vector<ClosingLine> lines;
  lines.push_back({formatted("%d frames, %d with a pose, %d doubtful, %d segment(s), %d keyframes, %zu edge "
                             "points, %zu lines; scale ",
                             n.frames, n.with_pose, n.doubtful, n.segments, n.keyframes, n.points, n.lines) +
                   run.scale_source});
  add_doubtful(run, &lines);
  add_without_pose(run, &lines);
  for (const std::string& line : links_in_words(run)) lines.push_back({line});
  add_mistaken(run, &lines);
  for (const std::string& fault : scale_faults_in_words(run)) lines.push_back({"scale: " + fault, true});
  if (n.doubtful_keyframes > 0 && !include_doubtful)
    lines.push_back(
        {formatted("%d keyframes were made in doubt: the maps are without their points "
                   "(--include-doubtful)",
                   n.doubtful_keyframes)});
  if (run.realtime) lines.push_back({latency_statement(run)});
  for (const std::string& warning : run_warnings(run)) lines.push_back({"WARNING: " + warning, true});
  lines.push_back({"results in " + out + " (listed in summary.yaml)"});
  return lines;
}

std::optional<std::string> failure_statement(const Run& run, const std::string& what,
                                             const std::string& earlier) {
  const RunCounts n = count(run);
  if (!n.mostly_failed() && !n.is_largely_untrusted()) return std::nullopt;
  return problem_of(n, what) + "; mostly: " + reason_of(run, n) +
         (earlier.empty() ? "" : "; the earlier run is kept in " + earlier);
}

}  // namespace edgevo
