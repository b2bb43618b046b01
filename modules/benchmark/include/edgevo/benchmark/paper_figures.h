#pragma once
// What the paper prints: the cells of its two tables of whole systems, as they stand there.
// Source: Wu, Vela, Pradalier, "Robust Monocular Edge Visual Odometry through Coarse-to-Fine Data
// Association", tables `evalrobustness` (twelve surveys of Symphony Lake, whole and every third frame) and
// `evalKITTI`.
#include <string>
#include <vector>

namespace edgevo {

/// Failure rate of a sequence in percent, averaged over ten trials; drift in cm/m.
struct PaperLakeCell {
  double rate_percent, drift_cm_per_m;  ///< failure rate and mean drift
};

/// One method on the lake: spring, summer, autumn, winter; milliseconds a frame, 0 where the paper prints
/// none.
struct PaperLakeRow {
  std::string method;       ///< as the paper names it
  PaperLakeCell full[4];    ///< every frame
  PaperLakeCell every3[4];  ///< every third frame
  double track_ms, map_ms;  ///< tracking and mapping
};
const std::vector<PaperLakeRow>& paper_lake_rows();  ///< in the order of the paper

/// The columns of the table on KITTI.
const std::vector<std::string>& paper_kitti_methods();

/// ATE in metres of each method on one sequence; 0 where the paper prints none. The last row is the mean
/// without sequence 01.
struct PaperKittiRow {
  std::string sequence;  ///< as the paper names it
  double ate_m[5];       ///< in the order of paper_kitti_methods()
};
const std::vector<PaperKittiRow>& paper_kitti_rows();  ///< in the order of the paper

}  // namespace edgevo
