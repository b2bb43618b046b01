#pragma once
// The paper's tables from trials that are run for them: the work of `edgevo table`.
#include <string>

#include "edgevo/benchmark/bench_host.h"
#include "edgevo/benchmark/printed_table.h"

namespace edgevo {

struct PaperTableRequest {
  std::string which;  ///< "1": seasons of a lake shore; "2": KITTI
  std::string out;    ///< folder of the table and its jobs
  std::string data;   ///< 1: an archive whose surveys are added; 2: folder of the sequences; may be empty
  std::string list;   ///< of sequences; empty: the one that ships with the program
  std::string seeds;  ///< as parse_seeds reads them; empty: those of the list, or `trials`
  int trials = 0;     ///< seeds 1 to so many; 0: those of the list
};

struct PaperTableResult {
  PrintedTable table;
  std::string stem;        ///< path of the written files without .md, .csv, .html
  int missing_trials = 0;  ///< trials without a result; their cells say so
};

/// Runs what is open of the table's list, one job at a time, and writes the table. Throws InputError: a bad
/// list or source, no engine.
PaperTableResult run_paper_table(const PaperTableRequest& request, const BenchHost& host);

}  // namespace edgevo
