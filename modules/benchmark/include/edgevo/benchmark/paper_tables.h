#pragma once
// The paper's two tables of whole systems with trials of ours beside its figures.
//
// A sequence's name in a list (share/bench/table1.yaml, table2.yaml) says where its trials stand: of the lake
// it is a season, or a survey's date YYMMDD, whose month tells the season; of KITTI it is the table's row
// (kitti00, kitti00_first300). Of a variant `every3` says the half of the lake's table; its detector and its
// light are named with the method.
#include <string>
#include <vector>

#include "edgevo/benchmark/printed_table.h"

namespace edgevo {

/// Failure of a trial, percent: the share of its stretches that drift by more than 30 cm/m or lack their
/// poses. A trial that could not be compared has failed throughout, with the drift of a failure.
double failure_percent(const Trial& trial);
double drift_with_failures(
    const Trial& trial);  ///< cm/m; of a trial that could not be compared that of a failure

/// "spring" of "spring" or "150415"; empty if it is neither a season nor a date.
std::string season_of(const std::string& sequence);

/// Table I: a row for each method of the paper, then one for each detector and light of ours, rendered scenes
/// and surveys apart. Means over the trials and sequences of a season [least..most].
PrintedTable lake_table(const BenchHeader& header, const std::vector<BenchRow>& rows,
                        const std::vector<std::string>& remarks);

/// Table II: ATE with the scale re-corrected every 200 frames. `not_at_hand`: sequences of the list whose
/// data is not there.
PrintedTable kitti_table(const BenchHeader& header, const std::vector<BenchRow>& rows,
                         const std::vector<std::string>& not_at_hand,
                         const std::vector<std::string>& remarks);

}  // namespace edgevo
