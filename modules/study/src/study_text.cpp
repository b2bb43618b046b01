// SPDX-License-Identifier: BSD-3-Clause
#include "study_text.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cell_statistics.h"
#include "edgevo/core/output_file.h"
#include "experiments.h"
#include "study_tables.h"

namespace edgevo {
namespace {

constexpr double kGoodDriftPercent = 10;  // a pair is solved if its drift is below this
constexpr double kGoodPairs = 0.9;        // share of solved pairs at a distance within a method's reach

std::string percent(double share) { return fixed(100 * share, 1) + " %"; }

std::string row(const std::vector<std::string>& fields) {
  std::string text = "|";
  for (const std::string& field : fields) text += " " + field + " |";
  return text + "\n";
}

std::string header(const std::vector<std::string>& names) {
  return row(names) + row(std::vector<std::string>(names.size(), "---"));
}

std::string with_error(double mean, double error) { return fixed(mean, 2) + " +- " + fixed(error, 2); }

// The samples of a method with one setting (or with all settings) under both lights, as one cell.
StudyCell pooled(const StudyResult& result, const std::string& curve, const std::string& method,
                 const std::string& setting = "") {
  StudyCell all;
  for (const StudyCell& cell : result.cells)
    if (cell.curve == curve && cell.method == method && (setting.empty() || cell.setting == setting))
      all.samples.insert(all.samples.end(), cell.samples.begin(), cell.samples.end());
  return all;
}

// Keeps, in cells over the same pairs, the pairs on which none failed.
void keep_common_pairs(std::vector<StudyCell>* cells) {
  std::vector<bool> is_good;
  for (const StudyCell& cell : *cells) {
    is_good.resize(cell.samples.size(), true);
    for (size_t i = 0; i < cell.samples.size(); ++i) is_good[i] = is_good[i] && !cell.samples[i].failed;
  }
  for (StudyCell& cell : *cells) {
    std::vector<StudySample> kept;
    for (size_t i = 0; i < cell.samples.size(); ++i)
      if (is_good[i]) kept.push_back(cell.samples[i]);
    cell.samples = std::move(kept);
  }
}

std::vector<std::string> settings_of(const StudyResult& result, const std::string& curve) {
  std::vector<std::string> settings;
  for (const StudyCell& cell : result.cells)
    if (cell.curve == curve && std::find(settings.begin(), settings.end(), cell.setting) == settings.end())
      settings.push_back(cell.setting);
  return settings;
}

std::string conclusion(bool holds, bool in_part) {
  return holds ? "**holds here**" : in_part ? "**holds here in part**" : "**does not hold here**";
}

// ---- the four observations ----

std::string gradient_is_best(const StudyResult& result) {
  const std::vector<std::string> names{"gradient", "intensity", "census"};
  std::vector<StudyCell> cells;
  for (const std::string& name : names) cells.push_back(pooled(result, "frame_distance", name));
  keep_common_pairs(&cells);
  bool is_lowest = true, is_clear = true;
  std::string table = header(
      {"patches", "mean drift %", "gradient's drift minus this", "direction deg", "wrong", "matching ms"});
  for (size_t i = 0; i < cells.size(); ++i) {
    const CellStatistics s = statistics(cells[i]);
    const Difference d = drift_difference(cells[0], cells[i]);
    is_lowest = is_lowest && d.mean <= 0;
    is_clear = is_clear && (i == 0 || (d.mean < 0 && d.is_clear()));
    table += row({names[i], with_error(s.drift_mean, s.drift_error), with_error(d.mean, d.error),
                  fixed(s.direction_mean_deg, 3), percent(s.wrong_share), fixed(s.match_ms, 2)});
  }
  return "### 1. Gradient patches are the best overall: " + conclusion(is_lowest && is_clear, is_lowest) +
         "\nThe " + std::to_string(cells[0].samples.size()) + " of " +
         std::to_string(pooled(result, "frame_distance", "gradient").samples.size()) +
         " pairs of all frame distances, both lights, on which none failed." +
         (is_lowest && !is_clear
              ? " Lowest drift, but not beyond chance (two standard errors) against both others."
              : "") +
         "\n\n" + table + "\n";
}

std::string k_of_one_works(const StudyResult& result) {
  constexpr double kAsGood = 1.1;  // drift within 10 % of the best
  const StudyCell one = pooled(result, "search_length", "gradient", "1");
  const StudyCell longest = pooled(result, "search_length", "gradient", "max");
  const double own = statistics(one).drift_mean;
  std::string table = header({"k", "mean drift %", "drift minus that of k = 1", "direction deg",
                              "2-D matches a pair", "wrong", "matching ms"});
  bool is_beaten = false;
  for (const std::string& k : settings_of(result, "search_length")) {
    const StudyCell cell = pooled(result, "search_length", "gradient", k);
    const CellStatistics s = statistics(cell);
    const Difference d = drift_difference(cell, one);
    is_beaten = is_beaten || (own > kAsGood * s.drift_mean && d.is_clear());
    table += row({k, with_error(s.drift_mean, s.drift_error), with_error(d.mean, d.error),
                  fixed(s.direction_mean_deg, 3), fixed(s.photometric, 0), percent(s.wrong_share),
                  fixed(s.match_ms, 2)});
  }
  const bool is_quicker = statistics(one).match_ms < statistics(longest).match_ms;
  return "### 2. The search length with k = 1 works well: " +
         conclusion(!is_beaten && is_quicker, is_quicker) + "\nGradient patches, both lights, " +
         std::to_string(result.options.distance) +
         " frames. It holds when no other k drifts less by more than a tenth and beyond chance (two standard "
         "errors), and k = 1 is quicker than the fixed length.\n\n" +
         table + "\n";
}

std::string adaption_pays(const StudyResult& result) {
  const CellStatistics adaptive = statistics(pooled(result, "patch_size", "gradient", "adaptive"));
  std::string table = header({"patch", "mean drift %", "direction deg", "2-D matches a pair", "wrong",
                              "median error px", "matching ms"});
  int beaten = 0, beating = 0, sizes = 0;
  for (const std::string& size : settings_of(result, "patch_size")) {
    const CellStatistics s = statistics(pooled(result, "patch_size", "gradient", size));
    table +=
        row({size, with_error(s.drift_mean, s.drift_error), fixed(s.direction_mean_deg, 3),
             fixed(s.photometric, 0), percent(s.wrong_share), fixed(s.median_px, 3), fixed(s.match_ms, 2)});
    if (size == "adaptive") continue;
    ++sizes;
    beaten += adaptive.match_ms < s.match_ms && adaptive.wrong_share < s.wrong_share;
    beating += s.match_ms < adaptive.match_ms && s.wrong_share < adaptive.wrong_share;
  }
  return "### 3. Adaptive patches take less time for better matches than fixed ones: " +
         conclusion(beaten == sizes, beaten > 0) +
         "\nGradient patches, both lights. In both time and share of wrong matches better than " +
         std::to_string(beaten) + " and worse than " + std::to_string(beating) + " of the " +
         std::to_string(sizes) + " fixed sizes.\n\n" + table + "\n";
}

// The largest distance up to which nearly all pairs are solved; 0: none.
int reach(const StudyResult& result, const std::string& light, const std::string& method) {
  int reached = 0;
  for (const StudyCell& cell : result.cells) {
    if (cell.curve != "frame_distance" || cell.light != light || cell.method != method ||
        cell.position != reached + 1)
      continue;
    const auto good = std::count_if(cell.samples.begin(), cell.samples.end(),
                                    [](const StudySample& s) { return s.drift_percent < kGoodDriftPercent; });
    if (double(good) < kGoodPairs * double(cell.samples.size())) break;
    reached = cell.position;
  }
  return reached;
}

// All distances under one light.
StudyCell all_distances(const StudyResult& result, const std::string& light, const std::string& method) {
  StudyCell all;
  for (const StudyCell& cell : result.cells)
    if (cell.curve == "frame_distance" && cell.light == light && cell.method == method)
      all.samples.insert(all.samples.end(), cell.samples.begin(), cell.samples.end());
  return all;
}

std::string motion_is_larger(const StudyResult& result) {
  bool is_always_larger = true, is_ever_larger = false;
  for (const char* light : kStudyLights)
    for (const char* flow : {"lucas_kanade", "epipolar_flow"}) {
      const bool is_larger = reach(result, light, "gradient") > reach(result, light, flow);
      is_always_larger = is_always_larger && is_larger;
      is_ever_larger = is_ever_larger || is_larger;
    }
  std::string table = header({"method", "reach, normal light", "reach, changed light",
                              "mean drift %, all distances, normal", "changed"});
  for (const char* method :
       {"gradient", "gradient_refined", "edge_matches", "front_end", "lucas_kanade", "epipolar_flow"}) {
    std::vector<std::string> fields{method};
    for (const char* light : kStudyLights) fields.push_back(std::to_string(reach(result, light, method)));
    for (const char* light : kStudyLights) {
      const CellStatistics s = statistics(all_distances(result, light, method));
      fields.push_back(with_error(s.drift_mean, s.drift_error));
    }
    table += row(fields);
  }
  return "### 4. Our association copes with larger motion than optical flow: " +
         conclusion(is_always_larger, is_ever_larger) + "\nReach: frames up to which " + percent(kGoodPairs) +
         " of the pairs drift less than " + fixed(kGoodDriftPercent, 0) +
         " %. It holds when the reach of gradient patches is larger than that of both flows under both "
         "lights. Ours cannot reach further than the front-end that it starts from.\n\n" +
         table + "\n";
}

// ---- further figures ----

std::string against_lucas_kanade(const StudyResult& result) {
  const std::string distance = std::to_string(result.options.distance);
  const double ours =
      statistics(find_cell(result, "frame_distance", "changed", "gradient", distance)).drift_mean;
  const double theirs =
      statistics(find_cell(result, "frame_distance", "changed", "lucas_kanade", distance)).drift_mean;
  return "Under changed light, " + distance + " frames apart, gradient patches drift " + fixed(ours, 2) +
         " %, pyramidal Lucas-Kanade " + fixed(theirs, 2) + " %: a ratio of " + fixed(ours / theirs, 3) +
         ".\n\n";
}

std::string residuals(const StudyResult& result) {
  const std::string setting = std::to_string(result.options.distance);
  std::string text = "## Two dimensions or one\nThe same points, " + setting +
                     " frames apart. Difference: drift minus that of photometric_2d, pair by pair. Errors of "
                     "the matches as they are found, along the edge's normal and along the edge (medians of "
                     "the absolute values; end points of 2-D matches only).\n\n";
  for (const char* light : kStudyLights) {
    text += std::string("Light ") + light + ":\n\n";
    text += header(
        {"matches", "mean drift %", "difference", "direction deg", "normal px", "tangential px", "wrong"});
    for (const StudyCell& cell : result.cells) {
      if (cell.curve != "residuals" || cell.light != light) continue;
      const CellStatistics s = statistics(cell);
      const Difference d =
          drift_difference(cell, find_cell(result, "residuals", light, "photometric_2d", setting));
      std::vector<MatchError> points;
      for (const MatchError& e : cell.errors)
        if (e.kind == MatchKind::kPhotometric) points.push_back(e);
      const bool has_points = !points.empty();
      const ErrorSummary errors = summarise(has_points ? points : cell.errors);
      text += row({cell.method, with_error(s.drift_mean, s.drift_error), with_error(d.mean, d.error),
                   fixed(s.direction_mean_deg, 3), fixed(errors.median_normal_px, 3),
                   has_points ? fixed(errors.median_tangent_px, 3) : "-",
                   has_points ? percent(errors.wrong_share) : "-"});
    }
    text += "\n";
  }
  return text;
}

std::string variants(const StudyResult& result) {
  const std::string setting = std::to_string(result.options.distance);
  const StudyCell own = pooled(result, "variants", "default", setting);
  std::string text = "## Other parameters\nGradient patches, both lights, " + setting +
                     " frames. Patch sizes in pixels (from to, where ambiguous ones grow), the least half "
                     "search length, refinement along the normal; the default is the odometry's.\n\n";
  text += header({"variant", "mean drift %", "drift minus the default's", "direction deg", "matches", "2-D",
                  "wrong", "matching ms"});
  for (const StudyCell& named : result.cells) {
    if (named.curve != "variants" || named.light != kStudyLights[0]) continue;
    const StudyCell cell = pooled(result, "variants", named.method, setting);
    const CellStatistics s = statistics(cell);
    const Difference d = drift_difference(cell, own);
    text += row({named.method, with_error(s.drift_mean, s.drift_error), with_error(d.mean, d.error),
                 fixed(s.direction_mean_deg, 3), fixed(s.matches, 0), fixed(s.photometric, 0),
                 percent(s.wrong_share), fixed(s.match_ms, 2)});
  }
  return text + "\n";
}

std::string confidences(const StudyResult& result) {
  std::string text =
      "## Do the confidences rank rightly?\nC_m against the end-point error of 2-D matches (all accepted, "
      "one patch size), C_d against the error of the depth that an edge match gives, as motion of its "
      "projection; wrong is more than " +
      fixed(kWrongMatchPx, 0) +
      " px. ROC area: chance that a right match ranks above a wrong one (0.5 says nothing, 1 is perfect). "
      "Sparsification area: under error rate over density; a ranking by chance gives the error rate "
      "itself.\n\n";
  text += header({"light", "matches", "measure", "wrong", "ROC area", "precision-recall area",
                  "sparsification area", "optimal"});
  for (const StudyCell& cell : result.cells) {
    if (cell.curve != "confidence") continue;
    const ConfidenceCurve c = confidence_curve(cell);
    text += row({cell.light, cell.method, cell.method == "edge_matches" ? "C_d" : "C_m",
                 percent(c.error_rate), fixed(c.roc_area, 3), fixed(c.precision_recall_area, 3),
                 fixed(c.sparsification_area, 3), fixed(c.optimal_area, 3)});
  }
  return text + "\n";
}

std::string introduction(const StudyResult& result) {
  const StudyOptions& o = result.options;
  const size_t pairs = result.cells.empty() ? 0 : result.cells.front().samples.size();
  return "# Data association against exact depth and pose\nThe paper's study (section V-A, Fig. paramstudy) "
         "on " +
         result.source + ": " + std::to_string(pairs) + " host frames, " + std::to_string(o.points) +
         " edge points in each, inverse depths with relative noise of " + fixed(o.noise, 3) +
         " (one standard deviation), seed " + std::to_string(o.seed) + ". The points move by " +
         fixed(result.median_flow_px_per_frame, 1) +
         " px a frame (median). The target comes as it is (normal) and under the lighting change `" +
         o.light +
         "` (changed). Drift: |t - t_true| / |t_true| of the two-view adjustment, in per cent; a pair that "
         "fails counts 100. Part of it is the scale, which the noisy depths carry and no matching can mend; "
         "direction is the angle between t and t_true, free of it (of the pairs that did not fail). Means "
         "with their standard errors. Times: CPU ms of one thread, of finding the matches, without edges, "
         "tracking (ours) and adjustment.\n\n";
}

}  // namespace

std::string study_text(const StudyResult& result) {
  return introduction(result) + "![drift](paramstudy.png)\n\n## The paper's four observations\n" +
         gradient_is_best(result) + k_of_one_works(result) + adaption_pays(result) +
         motion_is_larger(result) + against_lucas_kanade(result) + "![time](time.png)\n\n" +
         residuals(result) + "![errors of single matches](match_errors.png)\n\n" + variants(result) +
         confidences(result) + "![confidence](confidence.png)\n";
}

}  // namespace edgevo
