// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Table of many trials: one row per sequence and variant with the median and the maximum over its seeds.
//
// A trial without an error figure (too few poses to compare) counts as worse than any other: the median is
// "-" if half of the trials have none, and the maximum is "-" if one has none. Skipping such trials would
// reward losing track.
#include <string>
#include <utility>
#include <vector>

#include "edgevo/benchmark/trial.h"

namespace edgevo {

/// The trials of one sequence and variant.
struct BenchRow {
  /// Names in the list.
  std::string sequence, variant;
  /// Finished trials, one per seed.
  std::vector<Trial> trials;
  /// Number of unfinished trials: broken source, or not run yet.
  int missing = 0;
  /// Edge detector, if a word of the variant names one; else empty.
  std::string detector;
};

/// Header of a table as names and texts: version, machine, parameters, ... Without a date, so that the same
/// trials give the same bytes.
using BenchHeader = std::vector<std::pair<std::string, std::string>>;

/// Median; the mean of the middle two for an even number. Infinite values are allowed. NaN without values.
double median_of(std::vector<double> values);

/// Table as CSV: the header as comment lines, a line of names, one line per row.
std::string bench_csv(const BenchHeader& header, const std::vector<BenchRow>& rows);

/// Table as Markdown: the header as a list, then a table with "median (maximum)" in each cell.
std::string bench_markdown(const BenchHeader& header, const std::vector<BenchRow>& rows);

}  // namespace edgevo
