// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/benchmark/paper_run.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "edgevo/benchmark/bench_run.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/datasets/source_folder.h"
#include "edgevo/datasets/surveys.h"
#include "edgevo/files/program_folder.h"
#include "paper_tables.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// share/bench/table1.yaml of the source tree if it exists, else the one installed with the program.
std::string shipped_list(const std::string& which) {
  const std::string name = "table" + which + ".yaml";
  std::vector<fs::path> folders{data_folder() / "bench"};
#ifdef EDGEVO_BENCH_SOURCE_DIR
  folders.insert(folders.begin(), EDGEVO_BENCH_SOURCE_DIR);
#endif
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (fs::is_regular_file(folder / name, ignored)) return (folder / name).string();
  throw InputError(name, "is not installed", "give the list with --list");
}

std::string path_from(const std::string& list, const std::string& file) {
  return file.empty() ? "" : fs::absolute(fs::path(list).parent_path() / file).lexically_normal().string();
}

bool data_is_there(const std::string& path) {
  std::error_code ignored;
  try {
    return fs::exists(path, ignored) || fs::exists(source_folder(path), ignored);
  } catch (const InputError&) {  // an archive without a survey of that name
    return false;
  }
}

// The list with absolute paths, so that it can be moved; sequences without data are moved to `missing`.
BenchList with_available_data(BenchList list, const std::string& path, const std::string& data,
                              std::vector<std::string>* missing) {
  std::vector<BenchSequence> there;
  for (BenchSequence s : list.sequences) {
    const bool is_scene = s.source.rfind(kScenePrefix, 0) == 0;
    if (!is_scene)
      s.source = fs::absolute(fs::path(data.empty() ? "." : data) / s.source).lexically_normal().string();
    s.camera = path_from(path, s.camera), s.params = path_from(path, s.params);
    if (is_scene || data_is_there(s.source))
      there.push_back(s);
    else
      missing->push_back(s.name);
  }
  list.sequences = there;
  return list;
}

BenchVariant every(int n, const std::string& detector) {
  BenchVariant variant;
  if (n > 1) variant.name = "every" + std::to_string(n), variant.every = n;
  if (!detector.empty()) variant.name += "+" + detector, variant.detector = detector;
  return variant;
}

std::set<std::string> detectors_in(const BenchList& list) {
  std::set<std::string> detectors;
  for (const BenchSequence& sequence : list.sequences)
    for (const BenchVariant& variant : sequence.variants) detectors.insert(variant.detector);
  return detectors.empty() ? std::set<std::string>{""} : detectors;
}

// Adds each survey of the user with every and with every third frame, with each detector of the list.
void add_surveys(const std::string& data, BenchList* list) {
  const std::set<std::string> detectors = detectors_in(*list);
  for (const Survey& survey : surveys_in(data)) {
    BenchSequence sequence;
    sequence.name = survey.name;
    sequence.source = fs::absolute(survey.folder).lexically_normal().string();
    for (const std::string& detector : detectors)
      for (const int n : {1, 3}) sequence.variants.push_back(every(n, detector));
    list->sequences.push_back(sequence);
  }
}

BenchHeader paper_header(const BenchList& list, const std::string& version) {
  return {{"edgevo", version},
          {"machine", processor_name() + ", one thread a job"},
          {"trials", seeds_text(list) + "; cells are means [least..most] over trials"},
          {"paper",
           "Wu, Vela, Pradalier, Robust Monocular Edge Visual Odometry through Coarse-to-Fine Data "
           "Association; ten trials"}};
}

const char* const kLakeRemark =
    "What differs from the paper's setting: rendered shores replace its twelve surveys (which it does "
    "not name), with light changed as the row says; drift over intervals of 5, 10, 20 and 30 % of the path "
    "if that is under 400 m; failures are the intervals above 30 cm/m or without poses; track and map are "
    "CPU ms per frame on this machine, with the edges under track. Seasons of surveys go by the month "
    "of their date.";
const char* const kKittiRemark =
    "What differs from the paper's setting: pieces of 300 frames are not the whole sequences that its "
    "figures are of; edgevo calibrates residual distortion by itself (camera.refine); no loop closing, as "
    "there.";

// The truth of surveys without a map is GPS and compass: readers of the table must know.
std::string coarse_surveys(const BenchList& list) {
  std::string names;
  for (const BenchSequence& s : list.sequences) {
    if (s.source.rfind(kScenePrefix, 0) == 0 || !std::isdigit(static_cast<unsigned char>(s.name[0])))
      continue;
    SourceOptions options;
    options.path = s.source;
    options.any_camera = true;
    for (const auto& [name, value] : open_source(options)->details())
      if (name == "ground truth" && value.rfind("coarse", 0) == 0)
        names += (names.empty() ? "" : ", ") + s.name;
  }
  return names;
}

PrintedTable make_table(const std::string& which, const BenchHeader& header, const BenchList& list,
                        const std::vector<BenchRow>& rows, const std::vector<std::string>& missing) {
  if (which == "2") return kitti_table(header, rows, missing, {kKittiRemark});
  std::vector<std::string> remarks{kLakeRemark};
  if (const std::string names = coarse_surveys(list); !names.empty())
    remarks.push_back("Ground truth of " + names + " is coarse: GPS and compass, no Maps.");
  return lake_table(header, rows, remarks);
}

void write_table(const PrintedTable& table, const std::string& stem) {
  write_file(stem + ".md", table_markdown(table));
  write_file(stem + ".csv", table_csv(table));
  write_file(stem + ".html", table_html(table));
}

int missing_trials(const std::vector<BenchRow>& rows) {
  int missing = 0;
  for (const BenchRow& row : rows) missing += row.missing;
  return missing;
}

BenchList requested_list(const PaperTableRequest& request, std::vector<std::string>* missing) {
  const std::string path = request.list.empty() ? shipped_list(request.which) : request.list;
  BenchList list = read_bench_list(path);
  if (!request.seeds.empty()) list.seeds = parse_seeds(request.seeds, "--seeds");
  if (request.trials > 0) list.seeds = parse_seeds("1.." + std::to_string(request.trials), "--trials");
  list = with_available_data(list, path, request.data, missing);
  if (request.which == "1" && !request.data.empty()) add_surveys(request.data, &list);
  return list;
}

}  // namespace

PaperTableResult run_paper_table(const PaperTableRequest& request, const BenchHost& host) {
  std::error_code ignored;
  if (!request.data.empty() && !fs::is_directory(request.data, ignored))
    throw InputError(request.data, "no such folder", "give the folder of the data with --data DIR");
  std::vector<std::string> missing;
  BenchList list = requested_list(request, &missing);
  std::vector<BenchRow> rows;
  make_output_folder(request.out);
  if (!list.sequences.empty()) {
    const std::string path = (fs::path(request.out) / "list.yaml").string();
    write_file(path, bench_list_yaml(list));
    list = read_bench_list(path);
    rows = run_bench(list, {path, request.out, request.data.empty() ? "." : request.data}, {}, host).rows;
  }
  PaperTableResult result;
  result.table = make_table(request.which, paper_header(list, host.version), list, rows, missing);
  result.stem = (fs::path(request.out) / ("table" + request.which)).string();
  result.missing_trials = missing_trials(rows);
  write_table(result.table, result.stem);
  return result;
}

}  // namespace edgevo
