// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs the trials of the paper's tables and writes the tables, for `edgevo table`.
#include <string>

#include "edgevo/benchmark/bench_host.h"
#include "edgevo/benchmark/printed_table.h"

namespace edgevo {

/// Arguments of `edgevo table`.
struct PaperTableRequest {
  /// Number of the table. "1": seasons of a lake shore; "2": KITTI.
  std::string which;
  /// Output folder of the table and its jobs.
  std::string out;
  /// For table 1 an archive whose surveys are added, for table 2 the folder of the sequences; may be empty.
  std::string data;
  /// List of sequences; empty: the one that ships with the program.
  std::string list;
  /// Seeds as for parse_seeds(); empty: those of the list, or `trials`.
  std::string seeds;
  /// Number of seeds, from 1; 0: those of the list.
  int trials = 0;
};

/// Result of run_paper_table().
struct PaperTableResult {
  /// Table as written.
  PrintedTable table;
  /// Path of the written files, without .md, .csv and .html.
  std::string stem;
  /// Number of trials without a result, which is stated in their cells.
  int missing_trials = 0;
};

/// Runs the unfinished trials of the table's list, one job at a time, and writes the table. Throws InputError
/// for a bad list or source or a missing engine.
PaperTableResult run_paper_table(const PaperTableRequest& request, const BenchHost& host);

}  // namespace edgevo
