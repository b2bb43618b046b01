// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/benchmark/bench_table.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

// Value of a run without a result: worse than any other.
constexpr double kNone = std::numeric_limits<double>::infinity();

using Format = std::string (*)(double value);

// Three significant digits or more, from 123.46 down to 0.000312: errors range from kilometres to tenths of a
// millimetre.
std::string three_digits(double value) {
  const double leading = value > 0 ? std::floor(std::log10(value)) : 0;
  return fixed(value, int(std::clamp(2 - leading, 2.0, 6.0)));
}
std::string one_decimal(double value) { return fixed(value, 1); }
std::string whole(double value) { return fixed(value, 0); }

struct Column {
  const char* csv_name;
  const char* title;
  double (*value)(const Trial&);
  Format format;
  bool more_is_better;
};

double if_evaluated(const Trial& t, double value) { return t.evaluated ? value : kNone; }
double if_frames_evaluated(const Trial& t, double value) { return t.evaluated_frames > 0 ? value : kNone; }
double if_known(double value) { return value >= 0 ? value : kNone; }
// `nothing`: the share of nothing.
double percent_of(int part, int whole, double nothing) { return whole > 0 ? 100.0 * part / whole : nothing; }

const Column kColumns[] = {
    {"ate_m", "ATE Sim(3) m", [](const Trial& t) { return if_evaluated(t, t.ate_m); }, three_digits, false},
    {"ate_percent", "% of the path",
     [](const Trial& t) { return if_evaluated(t, t.path_m > 0 ? 100 * t.ate_m / t.path_m : kNone); },
     three_digits, false},
    {"ate200_m", "ATE200 m", [](const Trial& t) { return if_evaluated(t, t.ate200_m); }, three_digits, false},
    {"drift_cm_per_m", "drift cm/m", [](const Trial& t) { return if_evaluated(t, t.drift_cm_per_m); },
     three_digits, false},
    {"scale_error_percent", "scale off %",
     [](const Trial& t) { return if_evaluated(t, t.scale_error_percent); }, one_decimal, false},
    {"completion_percent", "frames with a pose %", [](const Trial& t) { return t.completion_percent; },
     one_decimal, true},
    {"segments", "segments", [](const Trial& t) { return double(t.segments); }, whole, false},
    {"doubtful_frames", "doubtful frames", [](const Trial& t) { return double(t.doubtful_frames); }, whole,
     false},
    {"wrong_frames", "wrong frames", [](const Trial& t) { return if_frames_evaluated(t, t.wrong_frames); },
     whole, false},
    {"noticed_percent", "noticed %",
     [](const Trial& t) { return if_frames_evaluated(t, percent_of(t.noticed_frames, t.wrong_frames, 100)); },
     one_decimal, true},
    {"false_alarm_percent", "false alarms %",
     [](const Trial& t) { return if_frames_evaluated(t, percent_of(t.false_alarms, t.right_frames, 0)); },
     one_decimal, false},
    {"longest_unnoticed", "longest unnoticed",
     [](const Trial& t) { return if_frames_evaluated(t, t.longest_unnoticed); }, whole, false},
    {"longest_off_scale", "longest off scale",
     [](const Trial& t) { return if_frames_evaluated(t, t.longest_off_scale); }, whole, false},
    {"roc_area", "ROC", [](const Trial& t) { return if_known(t.roc_area); }, three_digits, true},
    {"calibration_error", "calibration error", [](const Trial& t) { return if_known(t.calibration_error); },
     three_digits, false},
    {"nees_median", "NEES", [](const Trial& t) { return if_known(t.nees_median); }, one_decimal, false},
    {"cpu_ms", "CPU ms a frame", [](const Trial& t) { return t.cpu_ms; }, one_decimal, false},
};

std::string number(double value, Format format) { return std::isfinite(value) ? format(value) : "-"; }

struct MedianAndWorst {
  std::string median, worst;
};

MedianAndWorst summarise(const BenchRow& row, const Column& column) {
  std::vector<double> values;
  for (const Trial& trial : row.trials) values.push_back(column.value(trial));
  if (values.empty()) return {"-", "-"};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double worst = column.more_is_better ? *least : *most;
  return {number(median_of(values), column.format), number(worst, column.format)};
}

double path_of(const BenchRow& row) {
  for (const Trial& trial : row.trials)
    if (trial.path_m > 0) return trial.path_m;
  return kNone;
}

// Number of trials whose run would end with exit code 3.
int failed_trials(const BenchRow& row) {
  return int(
      std::count_if(row.trials.begin(), row.trials.end(), [](const Trial& t) { return t.has_failed; }));
}

std::string trials_text(const BenchRow& row) {
  const size_t ended = row.trials.size();
  return row.missing == 0 ? std::to_string(ended)
                          : std::to_string(ended) + " of " + std::to_string(ended + size_t(row.missing));
}

}  // namespace

double median_of(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::string bench_csv(const BenchHeader& header, const std::vector<BenchRow>& rows) {
  std::string text;
  for (const auto& [name, value] : header) text += "# " + name + ": " + value + '\n';
  text += "sequence,variant,trials,missing,path_m";
  for (const Column& c : kColumns) text += std::string(",") + c.csv_name + "_median," + c.csv_name + "_worst";
  text += ",exit_code_3\n";
  for (const BenchRow& row : rows) {
    text += row.sequence + ',' + row.variant + ',' + std::to_string(row.trials.size()) + ',' +
            std::to_string(row.missing) + ',' + number(path_of(row), three_digits);
    for (const Column& c : kColumns) {
      const MedianAndWorst s = summarise(row, c);
      text += ',' + s.median + ',' + s.worst;
    }
    text += ',' + std::to_string(failed_trials(row)) + '\n';
  }
  return text;
}

std::string bench_markdown(const BenchHeader& header, const std::vector<BenchRow>& rows) {
  std::string text, rule = "|---|---|---|---|";
  for (const auto& [name, value] : header) text += "- " + name + ": " + value + '\n';
  text += "\nMedian over the trials (worst trial in brackets).\n\n| sequence | variant | trials | path m |";
  for (const Column& c : kColumns) text += std::string(" ") + c.title + " |", rule += "---|";
  text += " exit code 3 |\n" + rule + "---|\n";
  for (const BenchRow& row : rows) {
    text += "| " + row.sequence + " | " + row.variant + " | " + trials_text(row) + " | " +
            number(path_of(row), one_decimal) + " |";
    for (const Column& c : kColumns) {
      const MedianAndWorst s = summarise(row, c);
      text += ' ' + s.median + " (" + s.worst + ") |";
    }
    text += ' ' + std::to_string(failed_trials(row)) + " of " + std::to_string(row.trials.size()) + " |\n";
  }
  return text;
}

}  // namespace edgevo
