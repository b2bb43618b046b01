// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Output of a study: tables, a text with the conclusions, and a gnuplot script with its plots.
//
//   search_length.csv, patch_size.csv, frame_distance.csv, residuals.csv, variants.csv
//                           one row for each curve, light, method and setting
//   end_point_error.csv     errors of the single matches; match_errors.csv: their distribution
//   confidence.csv          curves of C_m and C_d; confidence_areas.csv: their areas
//   study.md                the four observations of the paper, held against these numbers
//   plots.gnuplot           makes the plots (PNG and SVG) from the tables
// Times are in the last columns, whose names end in _ms; everything else depends on the seed alone.
#include <string>

#include "edgevo/study/study.h"

namespace edgevo {

/// Writes the tables, the text and the script. Throws InputError.
void write_study(const StudyResult& result, const std::string& folder);

/// Runs gnuplot on the script. False if there is no gnuplot or it fails; tables and script then remain.
[[nodiscard]] bool draw_plots(const std::string& folder);

}  // namespace edgevo
