// SPDX-License-Identifier: BSD-3-Clause
#include "paper_tables.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "paper_figures.h"

namespace edgevo {
namespace {

constexpr const char* kSeasons[4] = {"spring", "summer", "autumn", "winter"};
constexpr double kFailed_cm_per_m = 30;  // the paper's "maximum tracking error"
constexpr const char* kKitti = "kitti";
constexpr const char* kUsualDetector = "canny";

bool is_survey(const std::string& sequence) {
  return !sequence.empty() && std::isdigit(static_cast<unsigned char>(sequence[0]));
}

// Words of a variant: whether it takes every third frame, and other changes of the images.
struct VariantWords {
  bool every3 = false;
  std::string others;

  explicit VariantWords(const BenchRow& row) {
    const std::string& variant = row.variant;
    for (size_t begin = 0; begin <= variant.size();) {
      const size_t end = std::min(variant.find('+', begin), variant.size());
      const std::string word = variant.substr(begin, end - begin);
      every3 = every3 || word == "every3";
      if (word != "every3" && word != "normal" && word != row.detector)
        others += (others.empty() ? "" : "+") + word;
      begin = end + 1;
    }
  }
};

std::string detector_used(const BenchRow& row) {
  return row.detector.empty() ? kUsualDetector : row.detector;
}

struct Summary {
  std::vector<double> values;
  size_t missing = 0;

  TableCell cell() const {
    TableCell cell;
    if (values.empty()) return cell;
    double sum = 0;
    for (const double v : values) sum += v;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    cell.value = sum / double(values.size());
    if (values.size() > 1) cell.least = *least, cell.most = *most;
    if (missing > 0)
      cell.text =
          std::to_string(values.size()) + " of " + std::to_string(values.size() + missing) + " trials";
    return cell;
  }
};

TableCell plain(double value) {
  TableCell cell;
  if (value > 0) cell.value = value;
  return cell;
}

// ---- the lake ----

std::vector<std::string> lake_columns() {
  std::vector<std::string> columns;
  for (const char* thinned : {"", ", every 3rd"})
    for (const char* season : kSeasons)
      for (const char* figure : {" fail %", " cm/m"})
        columns.push_back(std::string(season) + thinned + figure);
  columns.insert(columns.end(), {"track ms", "map ms"});
  return columns;
}

TableRow paper_row(const PaperLakeRow& paper) {
  TableRow row{"paper: " + paper.method, {}, false};
  for (const auto* half : {paper.full, paper.every3})
    for (int s = 0; s < 4; ++s)
      row.cells.insert(row.cells.end(), {plain(half[s].rate_percent), plain(half[s].drift_cm_per_m)});
  row.cells.insert(row.cells.end(), {plain(paper.track_ms), plain(paper.map_ms)});
  return row;
}

std::string method_of(const BenchRow& row) {
  const std::string light = VariantWords(row).others;
  return "edgevo, " + detector_used(row) + (is_survey(row.sequence) ? ", surveys" : ", rendered") +
         (light.empty() ? "" : ", light " + light);
}

// Our rows that make up one row of the table.
using Rows = std::vector<const BenchRow*>;

template <class Value>
TableCell summarised(const Rows& rows, Value value) {
  Summary summary;
  for (const BenchRow* row : rows) {
    for (const Trial& trial : row->trials) summary.values.push_back(value(trial));
    summary.missing += size_t(row->missing);
  }
  return summary.cell();
}

Rows chosen(const Rows& rows, const std::string& season, bool every3) {
  Rows found;
  for (const BenchRow* row : rows)
    if (season_of(row->sequence) == season && VariantWords(*row).every3 == every3) found.push_back(row);
  return found;
}

TableRow own_row(const std::string& name, const Rows& rows) {
  TableRow row{name, {}, true};
  for (const bool every3 : {false, true})
    for (const char* season : kSeasons) {
      const Rows found = chosen(rows, season, every3);
      row.cells.insert(row.cells.end(),
                       {summarised(found, failure_percent), summarised(found, drift_with_failures)});
    }
  row.cells.push_back(summarised(rows, [](const Trial& t) { return t.track_ms; }));
  row.cells.push_back(summarised(rows, [](const Trial& t) { return t.map_ms; }));
  return row;
}

// ---- KITTI ----

// "00" for "kitti00"; any other name, such as that of a piece, is unchanged.
std::string kitti_row_name(const std::string& sequence) {
  const std::string rest =
      sequence.rfind(kKitti, 0) == 0 ? sequence.substr(std::string(kKitti).size()) : sequence;
  return rest.size() == 2 ? rest : sequence;
}

bool is_whole(const std::string& row_name) { return row_name.size() == 2; }

TableCell ate_cell(const std::vector<BenchRow>& rows, const std::string& name, const std::string& detector) {
  Summary ate;
  size_t lost = 0;
  for (const BenchRow& row : rows) {
    if (kitti_row_name(row.sequence) != name || detector_used(row) != detector) continue;
    ate.missing += size_t(row.missing);
    for (const Trial& trial : row.trials) {
      lost += !trial.evaluated;
      if (trial.evaluated) ate.values.push_back(trial.ate200_m);
    }
  }
  if (lost == 0) return ate.cell();
  TableCell cell;  // a mean over the other trials would reward losing track
  cell.text = std::to_string(lost) + " of " + std::to_string(lost + ate.values.size()) + " trials failed";
  return cell;
}

// Mean over the sequences of the paper, if all of them are available.
TableCell mean_of_whole(const std::vector<TableRow>& rows, size_t column) {
  double sum = 0;
  int count = 0;
  for (const TableRow& row : rows) {
    if (!is_whole(row.name) || row.name == "01" || row.name == "10") continue;
    if (!row.cells[column].value) return {};
    sum += *row.cells[column].value, ++count;
  }
  TableCell cell;
  if (count > 0) cell.value = sum / count;
  return cell;
}

std::vector<std::string> kitti_row_names(const std::vector<BenchRow>& rows,
                                         const std::vector<std::string>& unavailable) {
  std::vector<std::string> names;
  for (const PaperKittiRow& paper : paper_kitti_rows())
    if (is_whole(paper.sequence)) names.push_back(paper.sequence);
  std::vector<std::string> ours = unavailable;
  for (const BenchRow& row : rows) ours.push_back(row.sequence);
  std::vector<std::string> others;
  for (const std::string& sequence : ours) others.push_back(kitti_row_name(sequence));
  std::sort(others.begin(), others.end());
  for (const std::string& name : others)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

const PaperKittiRow* paper_kitti_row(const std::string& name) {
  for (const PaperKittiRow& paper : paper_kitti_rows())
    if (paper.sequence == name) return &paper;
  return nullptr;
}

std::vector<TableCell> paper_cells(const std::string& name) {
  std::vector<TableCell> cells(paper_kitti_methods().size());
  if (const PaperKittiRow* paper = paper_kitti_row(name))
    for (size_t i = 0; i < cells.size(); ++i) cells[i] = plain(paper->ate_m[i]);
  return cells;
}

}  // namespace

double failure_percent(const Trial& trial) { return trial.evaluated ? trial.failure_percent : 100.0; }
double drift_with_failures(const Trial& trial) {
  return trial.evaluated ? trial.drift_cm_per_m : kFailed_cm_per_m;
}

std::string season_of(const std::string& sequence) {
  for (const char* season : kSeasons)
    if (sequence == season) return season;
  if (!is_survey(sequence) || sequence.size() < 4) return {};
  const int month = std::atoi(sequence.substr(2, 2).c_str());
  if (month < 1 || month > 12) return {};
  return kSeasons[(month + 9) % 12 / 3];  // spring begins in March
}

PrintedTable lake_table(const BenchHeader& header, const std::vector<BenchRow>& rows,
                        const std::vector<std::string>& remarks) {
  PrintedTable table{"Table I: seasons of a lake shore, whole and every third frame",
                     "method",
                     header,
                     lake_columns(),
                     {},
                     remarks,
                     1};
  for (const PaperLakeRow& paper : paper_lake_rows()) table.rows.push_back(paper_row(paper));
  std::vector<std::pair<std::string, Rows>> methods;  // in the order of the list
  for (const BenchRow& row : rows) {
    const std::string method = method_of(row);
    auto it = std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.first == method; });
    if (it == methods.end()) it = methods.insert(methods.end(), {method, {}});
    it->second.push_back(&row);
  }
  for (const auto& [method, own] : methods) table.rows.push_back(own_row(method, own));
  return table;
}

PrintedTable kitti_table(const BenchHeader& header, const std::vector<BenchRow>& rows,
                         const std::vector<std::string>& unavailable,
                         const std::vector<std::string>& remarks) {
  PrintedTable table{"Table II: KITTI, ATE in metres, scale re-corrected every 200 frames",
                     "sequence",
                     header,
                     {},
                     {},
                     remarks,
                     2};
  for (const std::string& method : paper_kitti_methods()) table.columns.push_back("paper: " + method);
  std::vector<std::string> detectors;
  for (const BenchRow& row : rows)
    if (std::find(detectors.begin(), detectors.end(), detector_used(row)) == detectors.end())
      detectors.push_back(detector_used(row));
  if (detectors.empty()) detectors.push_back(kUsualDetector);
  for (const std::string& detector : detectors) table.columns.push_back("edgevo, " + detector);
  const auto is_missing = [&](const std::string& name) {
    return std::any_of(unavailable.begin(), unavailable.end(),
                       [&](const std::string& s) { return kitti_row_name(s) == name; });
  };
  for (const std::string& name : kitti_row_names(rows, unavailable)) {
    TableRow row{name, paper_cells(name), false};
    for (const std::string& detector : detectors) {
      row.cells.push_back(ate_cell(rows, name, detector));
      if (!row.cells.back().value && row.cells.back().text.empty() && is_missing(name))
        row.cells.back().text = "not available";
    }
    table.rows.push_back(row);
  }
  const std::string mean = paper_kitti_rows().back().sequence;
  TableRow last{mean, paper_cells(mean), false};
  for (size_t i = 0; i < detectors.size(); ++i)
    last.cells.push_back(mean_of_whole(table.rows, last.cells.size()));
  table.rows.push_back(last);
  return table;
}

}  // namespace edgevo
