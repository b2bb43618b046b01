// SPDX-License-Identifier: BSD-3-Clause
// share/doc/file_formats.md names every file, column, property and key that a run writes.
#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "edgevo/benchmark/bench_table.h"
#include "edgevo/benchmark/trial.h"
#include "edgevo/core/input_file.h"
#include "edgevo/occupancy/line_table.h"
#include "edgevo/results/run_text.h"
#include "run_files.h"
#include "written_run.h"

namespace edgevo {
namespace {

using test::cells_of;
using test::content;
using test::lines_of;

// Words of the page in backquotes; one pair may hold several.
std::set<std::string> named_words(const std::string& page) {
  static const std::regex kQuoted("`([^`\n]+)`"), kWord("[A-Za-z_0-9.]+");
  std::set<std::string> words;
  for (std::sregex_iterator q(page.begin(), page.end(), kQuoted), end; q != end; ++q) {
    const std::string quoted = (*q)[1];
    for (std::sregex_iterator w(quoted.begin(), quoted.end(), kWord); w != end; ++w) words.insert(w->str());
  }
  return words;
}

// Keys of a summary, without those that depend on the run (stages, notes, parameters).
std::vector<std::string> summary_keys(const std::string& summary) {
  static const std::regex kKey("^( *)([a-z_0-9]+):.*$");
  std::vector<std::string> keys, path;
  std::smatch m;
  for (const std::string& line : lines_of(summary)) {
    if (!std::regex_match(line, m, kKey)) continue;
    path.resize(m[1].length() / 2, "");
    const bool is_free = (!path.empty() && (path[0] == "notes" || path[0] == "parameters")) ||
                         (path.size() == 2 && path[1] == "stages_ms");
    path.push_back(m[2]);
    if (!is_free) keys.push_back(m[2]);
  }
  return keys;
}

class FileFormats : public WrittenRun {
 protected:
  void expect_named(const std::vector<std::string>& names, const std::string& where) const {
    EXPECT_GT(names.size(), 3u) << where;
    for (const std::string& name : names)
      EXPECT_TRUE(named_.count(name)) << where << ": " << name << " is not in share/doc/file_formats.md";
  }
  // Comma-separated words in the first line of a text.
  static std::vector<std::string> header_of(const std::string& csv) {
    return cells_of(lines_of(csv).front());
  }

  const std::set<std::string> named_ =
      named_words(read_file(std::string(EDGEVO_SOURCE_DIR) + "/share/doc/file_formats.md", ""));
};

TEST_F(FileFormats, FilesOfARun) {
  const std::string page = read_file(std::string(EDGEVO_SOURCE_DIR) + "/share/doc/file_formats.md", "");
  std::string headings;
  for (const std::string& line : lines_of(page))
    if (line.rfind("### ", 0) == 0) headings += line + '\n';
  for (const RunFile& file : run_files())
    EXPECT_THAT(headings, ::testing::HasSubstr(file.name)) << "no section";
}

TEST_F(FileFormats, ColumnsOfTables) {
  expect_named(header_of(frames_csv({})), "frames.csv");
  expect_named(header_of(scale_csv({})), "scale.csv");
  expect_named(header_of(graph_csv({})), "graph.csv");
  expect_named(header_of(line_table_csv({})), "edge_segments.csv");
}

// The page names NAME_median and NAME_worst as NAME.
TEST_F(FileFormats, FiguresOfABench) {
  std::vector<std::string> columns;
  for (const std::string& column : header_of(bench_csv({}, {})))
    columns.push_back(std::regex_replace(column, std::regex("_(median|worst)$"), ""));
  EXPECT_THAT(columns, ::testing::Contains("ate200_m"));
  expect_named(columns, "table.csv");
  Trial trial;
  const std::string result = write_params([&](ParamVisitor& v) { trial.visit(v); });
  expect_named(summary_keys(result), "result.yaml");
}

TEST_F(FileFormats, PropertiesOfPoints) {
  write(folder_, made_.run, made_.camera);
  const std::string ply = content(folder_ / "edges.ply");
  static const std::regex kProperty("\nproperty [a-z]+ ([a-z_0-9]+)");
  std::vector<std::string> properties;
  for (std::sregex_iterator m(ply.begin(), ply.begin() + long(ply.find("end_header")), kProperty), end;
       m != end; ++m)
    properties.push_back((*m)[1]);
  expect_named(properties, "edges.ply");
}

TEST_F(FileFormats, KeysOfTheSummary) {
  edgevo::Run run = made_.run;
  run.realtime = RealtimeRecord();
  run.scale_source = "factor=2";
  run.scale.problem = "none";
  run.scale.faults.emplace_back();
  run.camera.given.set(CameraNumber::kK1, 0, 0.1), run.camera.given.set(CameraNumber::kReadout, 0, 0.1);
  for (FrameRecord& frame : run.frames) frame.latency_ms = 1;
  write(folder_, run, made_.camera);
  const std::vector<std::string> keys = summary_keys(content(folder_ / "summary.yaml"));
  EXPECT_THAT(keys, ::testing::IsSupersetOf(
                        {"libraries", "problem", "scale_faults", "readout_estimate", "stages_ms", "p99"}));
  expect_named(keys, "summary.yaml");
}

TEST_F(FileFormats, KeysAreFound) {
  const std::vector<std::string> keys = summary_keys(
      "a: 1\ntiming:\n  stages_ms:\n    edges:\n      mean: 1\n  wall_s: 2\nnotes:\n  seed: 3\nparameters:\n "
      " x: 1\n");
  EXPECT_THAT(keys,
              ::testing::ElementsAre("a", "timing", "stages_ms", "mean", "wall_s", "notes", "parameters"));
}

}  // namespace
}  // namespace edgevo
