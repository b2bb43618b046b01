// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The paper's two tables of whole systems, with our trials next to its figures.
//
// The name of a sequence in a list (share/bench/table1.yaml, table2.yaml) determines the position of its
// trials: on the lake it is a season, or the date YYMMDD of a survey, whose month gives the season; on KITTI
// it is the row of the table (kitti00, kitti00_first300). The word `every3` of a variant selects the half of
// the lake's table; its detector and light are named with the method.
#include <string>
#include <vector>

#include "edgevo/benchmark/printed_table.h"

namespace edgevo {

/// Failure of a trial, percent: the share of its intervals that drift by more than 30 cm/m or lack poses; 100
/// for a trial that could not be compared.
double failure_percent(const Trial& trial);
/// Drift of a trial, cm/m; that of a failure for a trial that could not be compared.
double drift_with_failures(const Trial& trial);

/// Season of a sequence: "spring" for "spring" or "150415"; empty if the name is neither a season nor a date.
std::string season_of(const std::string& sequence);

/// Table I: a row for each method of the paper, then one for each of our detectors and lights, separately for
/// rendered scenes and surveys. Cells are means over the trials and sequences of a season [minimum..maximum].
PrintedTable lake_table(const BenchHeader& header, const std::vector<BenchRow>& rows,
                        const std::vector<std::string>& remarks);

/// Table II: ATE with the scale re-corrected every 200 frames. `unavailable`: sequences of the list
/// without data.
PrintedTable kitti_table(const BenchHeader& header, const std::vector<BenchRow>& rows,
                         const std::vector<std::string>& unavailable,
                         const std::vector<std::string>& remarks);

}  // namespace edgevo
