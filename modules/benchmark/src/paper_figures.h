// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Figures of the paper: the cells of its two tables of whole systems, as printed.
// Source: Wu, Vela, Pradalier, "Robust Monocular Edge Visual Odometry through Coarse-to-Fine Data
// Association", tables `evalrobustness` (twelve surveys of Symphony Lake, whole and every third frame) and
// `evalKITTI`.
#include <string>
#include <vector>

namespace edgevo {

/// Figures of one sequence, averaged over ten trials.
struct PaperLakeCell {
  /// Failure rate, percent, and mean drift, cm/m.
  double rate_percent, drift_cm_per_m;
};

/// One method on the lake: spring, summer, autumn, winter.
struct PaperLakeRow {
  /// Name of the method in the paper.
  std::string method;
  /// Figures with every frame.
  PaperLakeCell full[4];
  /// Figures with every third frame.
  PaperLakeCell every3[4];
  /// Time of tracking and of mapping, milliseconds per frame; 0 if not printed.
  double track_ms, map_ms;
};
/// Rows of the table on the lake, in the order of the paper.
const std::vector<PaperLakeRow>& paper_lake_rows();

/// Columns of the table on KITTI.
const std::vector<std::string>& paper_kitti_methods();

/// ATE of each method on one sequence. The last row is the mean without sequence 01.
struct PaperKittiRow {
  /// Name of the sequence in the paper.
  std::string sequence;
  /// ATE, metres, in the order of paper_kitti_methods(); 0 if not printed.
  double ate_m[5];
};
/// Rows of the table on KITTI, in the order of the paper.
const std::vector<PaperKittiRow>& paper_kitti_rows();

}  // namespace edgevo
