// The paper's tables with our trials beside its figures.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>

#include "bench_run.h"
#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/program_folder.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/datasets/source_place.h"
#include "edgevo/datasets/surveys.h"
#include "edgevo/evaluation/paper_tables.h"
#include "option_checks.h"
#include "signals.h"
#include "version.h"

namespace edgevo::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kScene = "scene:";

struct TableArguments {
  std::string which, out, data, list, seeds;
  int trials = 0;
};

// share/bench/table1.yaml of the source tree while one works in it, else what is installed beside the
// program.
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

std::string beside(const std::string& list, const std::string& file) {
  return file.empty() ? "" : fs::absolute(fs::path(list).parent_path() / file).lexically_normal().string();
}

bool is_there(const std::string& path) {
  std::error_code ignored;
  try {
    return fs::exists(path, ignored) || fs::exists(source_place(path), ignored);
  } catch (const InputError&) {  // an archive, which has no survey of that name
    return false;
  }
}

// The list with full paths, so that it means the same wherever it lies; sequences whose data is not there go
// to `missing`.
BenchList at_hand(BenchList list, const std::string& path, const std::string& data,
                  std::vector<std::string>* missing) {
  std::vector<BenchSequence> there;
  for (BenchSequence s : list.sequences) {
    const bool is_scene = s.source.rfind(kScene, 0) == 0;
    if (!is_scene)
      s.source = fs::absolute(fs::path(data.empty() ? "." : data) / s.source).lexically_normal().string();
    s.camera = beside(path, s.camera), s.params = beside(path, s.params);
    if (is_scene || is_there(s.source))
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

// Each survey of the user's, whole and every third frame, by each detector of the list.
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

std::string seeds_text(const BenchList& list) {
  std::string seeds;
  for (const uint64_t seed : list.seeds) seeds += (seeds.empty() ? "" : " ") + std::to_string(seed);
  return std::to_string(list.seeds.size()) + " of each, seeds " + seeds;
}

BenchHeader make_header(const BenchList& list) {
  return {{"edgevo", version()},
          {"machine", processor_name() + ", one thread a job"},
          {"trials", seeds_text(list) + "; cells are means [least..most] over trials"},
          {"paper",
           "Wu, Vela, Pradalier, Robust Monocular Edge Visual Odometry through Coarse-to-Fine Data "
           "Association; ten trials"}};
}

const char* const kLakeRemark =
    "What differs from the paper's setting: rendered shores stand in for its twelve surveys (which ones it "
    "does not say), their light changed as "
    "the row says; drift over stretches of 5, 10, 20 and 30 % of the path where that is under 400 m; "
    "failures are the stretches above 30 cm/m or "
    "without poses; track and map are CPU ms a frame on this machine, with the edges under track. Seasons of "
    "surveys go by the month of their date.";
const char* const kKittiRemark =
    "What differs from the paper's setting: pieces of 300 frames are not the whole sequences that its "
    "figures are of; edgevo calibrates residual "
    "distortion by itself (camera.refine); no loop closing, as there.";

// Of surveys without a map the truth is GPS and compass: who reads the table must know.
std::string coarse_surveys(const BenchList& list) {
  std::string names;
  for (const BenchSequence& s : list.sequences) {
    if (s.source.rfind(kScene, 0) == 0 || !std::isdigit(static_cast<unsigned char>(s.name[0]))) continue;
    SourceOptions options;
    options.path = s.source;
    options.any_camera = true;
    for (const auto& [name, value] : open_source(options)->details())
      if (name == "ground truth" && value.rfind("coarse", 0) == 0)
        names += (names.empty() ? "" : ", ") + s.name;
  }
  return names;
}

PrintedTable make_table(const TableArguments& args, const BenchList& list, const std::vector<BenchRow>& rows,
                        const std::vector<std::string>& missing) {
  if (args.which == "2") return kitti_table(make_header(list), rows, missing, {kKittiRemark});
  std::vector<std::string> remarks{kLakeRemark};
  if (const std::string names = coarse_surveys(list); !names.empty())
    remarks.push_back("Ground truth of " + names + " is coarse: GPS and compass, no Maps.");
  return lake_table(make_header(list), rows, remarks);
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

BenchList asked_list(const TableArguments& args, std::vector<std::string>* missing) {
  const std::string path = args.list.empty() ? shipped_list(args.which) : args.list;
  BenchList list = read_bench_list(path);
  if (!args.seeds.empty()) list.seeds = parse_seeds(args.seeds, "--seeds");
  if (args.trials > 0) list.seeds = parse_seeds("1.." + std::to_string(args.trials), "--trials");
  list = at_hand(list, path, args.data, missing);
  if (args.which == "1" && !args.data.empty()) add_surveys(args.data, &list);
  return list;
}

int table(const TableArguments& args) {
  std::error_code ignored;
  if (!args.data.empty() && !fs::is_directory(args.data, ignored))
    throw InputError(args.data, "no such folder", "give the folder of the data with --data DIR");
  std::vector<std::string> missing;
  BenchList list = asked_list(args, &missing);
  std::vector<BenchRow> rows;
  if (!list.sequences.empty()) {
    make_output_folder(args.out);
    const std::string path = (fs::path(args.out) / "list.yaml").string();
    write_file(path, bench_list_yaml(list));
    list = read_bench_list(path);
    rows = run_list(list, path, args.out, args.data.empty() ? "." : args.data);
  }
  make_output_folder(args.out);
  const PrintedTable printed = make_table(args, list, rows, missing);
  const std::string stem = (fs::path(args.out) / ("table" + args.which)).string();
  write_table(printed, stem);
  std::printf("%s\n%s.md, .csv and .html\n", table_markdown(printed).c_str(), stem.c_str());
  if (interrupted()) throw InputError(args.out, "interrupted", "call again to go on");
  if (const int count = missing_trials(rows); count > 0)
    throw InputError(args.out, std::to_string(count) + " trials have no result; their cells say so",
                     "see what `edgevo bench " + args.out + "/list.yaml -o " + args.out + "` says");
  return 0;
}

}  // namespace

void add_table_command(CLI::App& app, Action* action) {
  CLI::App* command =
      app.add_subcommand("table", "the paper's tables I and II: its figures and ours, as text, CSV and HTML");
  auto args = std::make_shared<TableArguments>();
  command->add_option("TABLE", args->which, "1: seasons of a lake shore; 2: KITTI")
      ->required()
      ->check(CLI::IsMember({"1", "2"}));
  command
      ->add_option("-o,--out", args->out,
                   "folder for the table and its jobs; jobs that ended there before are not run again")
      ->required()
      ->check(path_given());
  command
      ->add_option("--data", args->data,
                   "1: an archive of Symphony Lake, whose surveys are added; 2: the folder of the sequences")
      ->check(path_given());
  CLI::Option* trials = command->add_option(
      "--trials", args->trials, "how many of each, with seeds 1 to N (default: those of the list)");
  trials->check(whole_number(1, 1000));
  command->add_option("--seeds", args->seeds, "which seeds instead, as 1..5 or \"1 2 7\"")->excludes(trials);
  command
      ->add_option("--list", args->list,
                   "another list of sequences (default: share/bench/table1.yaml, table2.yaml)")
      ->check(path_given());
  command->callback([=] { *action = [=] { return table(*args); }; });
}

}  // namespace edgevo::app
