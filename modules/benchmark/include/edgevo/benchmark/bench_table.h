#pragma once
// Many trials as a table: one row a sequence and variant, the median over its seeds and the worst of them.
//
// A trial without an error figure (it had too few poses to compare) counts as worse than any other: the
// median is "-" once half the trials have none, and the worst is "-" with the first. A table that left them
// out would reward losing track.
#include <string>
#include <utility>
#include <vector>

#include "edgevo/benchmark/trial.h"

namespace edgevo {

/// The trials of one sequence and variant.
struct BenchRow {
  std::string sequence, variant;  ///< as the list names them
  std::vector<Trial> trials;      ///< those that ended; one a seed
  int missing = 0;                ///< trials that did not: a broken source, or not run yet
  std::string detector;           ///< of edges, where a word of the variant names one; else empty
};

/// What stands above a table, as name and text: version, machine, parameters, ... No date: the same trials
/// give the same bytes.
using BenchHeader = std::vector<std::pair<std::string, std::string>>;

/// Middle of the values, or the mean of the two in the middle; infinity counts as any other. NaN for none.
double median_of(std::vector<double> values);

/// The header as comment lines, then one line of names and one a row.
std::string bench_csv(const BenchHeader& header, const std::vector<BenchRow>& rows);

/// The header as a list, then a table with "median (worst)" in each cell.
std::string bench_markdown(const BenchHeader& header, const std::vector<BenchRow>& rows);

}  // namespace edgevo
