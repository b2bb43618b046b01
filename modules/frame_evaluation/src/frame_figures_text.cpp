// SPDX-License-Identifier: BSD-3-Clause
// The figures of single frames as text, Markdown and JSON.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "edgevo/core/angle.h"
#include "edgevo/core/output_file.h"
#include "edgevo/frame_evaluation/frame_figures.h"

namespace edgevo {
namespace {

using Json = nlohmann::ordered_json;
using Cells = std::vector<std::string>;

const Cells& titles() {
  static const Cells list{"poses",
                          "evaluated",
                          "wrong",
                          "noticed %",
                          "false alarms %",
                          "longest unnoticed",
                          "longest off scale",
                          "ROC",
                          "calibration error",
                          "NEES 5, 50, 95 %"};
  return list;
}

std::string number(const std::optional<double>& value, int decimals) {
  return value ? fixed(*value, decimals) : "-";
}

std::string nees_text(const std::optional<NeesFigures>& nees) {
  if (!nees) return "-";
  return fixed(nees->low, 1) + ", " + fixed(nees->median, 1) + ", " + fixed(nees->high, 1);
}

Cells cells_of(const NamedFigures& row) {
  const FrameFigures& f = row.figures;
  return {row.name,
          std::to_string(f.frames_evaluated),
          std::to_string(f.wrong),
          number(f.recall_percent, 1),
          number(f.false_alarm_percent, 1),
          std::to_string(f.longest_unnoticed),
          std::to_string(f.longest_off_scale),
          number(f.roc, 3) + (f.roc && f.is_roc_of_state ? " (state)" : ""),
          number(f.calibration_error, 3),
          nees_text(f.nees)};
}

// Two digits, without an exponent.
std::string rounded(double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, value < 99.5 ? "%.2g" : "%.0f", value);
  return buffer;
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_of(const NamedFigures& row) {
  const FrameFigures& f = row.figures;
  Json nees = nullptr;
  if (f.nees)
    nees = {{"frames", f.nees->frames},
            {"percentile_5", f.nees->low},
            {"median", f.nees->median},
            {"percentile_95", f.nees->high}};
  return {{"poses", row.name},
          {"runs", f.runs},
          {"frames", f.frames},
          {"evaluated", f.frames_evaluated},
          {"below_noise", f.below_noise},
          {"wrong", f.wrong},
          {"noticed", f.noticed},
          {"right", f.right},
          {"false_alarms", f.false_alarms},
          {"recall_percent", or_null(f.recall_percent)},
          {"false_alarm_percent", or_null(f.false_alarm_percent)},
          {"longest_unnoticed", f.longest_unnoticed},
          {"longest_off_scale", f.longest_off_scale},
          {"roc_area", or_null(f.roc)},
          {"roc_of", f.is_roc_of_state ? "state" : "p_right"},
          {"calibration_error", or_null(f.calibration_error)},
          {"nees", nees}};
}

}  // namespace

std::string frame_figures_table(const std::vector<NamedFigures>& rows) {
  std::vector<Cells> lines{titles()};
  for (const NamedFigures& row : rows) lines.push_back(cells_of(row));
  std::vector<size_t> width(titles().size(), 0);
  for (const Cells& line : lines)
    for (size_t c = 0; c < line.size(); ++c) width[c] = std::max(width[c], line[c].size());
  std::string text;
  for (const Cells& line : lines) {
    for (size_t c = 0; c < line.size(); ++c) {
      const std::string blanks(width[c] - line[c].size(), ' ');
      text += c == 0 ? line[c] + blanks : "  " + blanks + line[c];
    }
    text += '\n';
  }
  return text;
}

std::string frame_figures_markdown(const std::vector<NamedFigures>& rows) {
  std::string text, rule;
  for (const std::string& title : titles()) text += "| " + title + " ", rule += "|---";
  text += "|\n" + rule + "|\n";
  for (const NamedFigures& row : rows) {
    for (const std::string& cell : cells_of(row)) text += "| " + cell + " ";
    text += "|\n";
  }
  return text;
}

std::string frame_figures_json(const std::vector<NamedFigures>& rows) {
  Json out = Json::array();
  for (const NamedFigures& row : rows) out.push_back(json_of(row));
  return out.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string frame_section(const std::vector<NamedFigures>& rows, const TruthNoise& noise) {
  const FrameFigures& first = rows.front().figures;
  const std::string hidden = first.below_noise == 0 ? ""
                                                    : ", which hides " + std::to_string(first.below_noise) +
                                                          " of " + std::to_string(first.frames) + " frames";
  return "\nsingle frames: the motion over the next ten; noise of the ground truth " +
         rounded(1000 * noise.position_m) + " mm, " + rounded(deg(noise.rotation_rad)) + " deg" + hidden +
         "\n" + frame_figures_table(rows);
}

std::vector<JsonMember> frame_members(const std::vector<NamedFigures>& rows, const TruthNoise& noise) {
  const Json noise_json = {{"position_m", noise.position_m}, {"rotation_rad", noise.rotation_rad}};
  return {{"truth_noise", noise_json.dump()}, {"single_frames", frame_figures_json(rows)}};
}

}  // namespace edgevo
