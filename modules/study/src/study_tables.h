// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tables of a study as text.
#include <string>

#include "edgevo/study/study.h"

namespace edgevo {

/// Table such as search_length.csv: one row for each cell.
std::string curve_table(const StudyResult& result, const std::string& curve);
/// end_point_error.csv: individual matches of the curve "residuals".
std::string end_point_table(const StudyResult& result);
/// match_errors.csv: distribution of the end-point errors, 100 steps from 0.02 to 200 pixels.
std::string match_error_table(const StudyResult& result);
/// confidence.csv, with at most 200 rows for each curve.
std::string confidence_table(const StudyResult& result);
/// confidence_areas.csv.
std::string confidence_area_table(const StudyResult& result);

/// Curve of a cell of "confidence": C_m against the end-point error of photometric matches, C_d against the
/// depth error of edge matches. Both thresholds are kWrongMatchPx.
ConfidenceCurve confidence_curve(const StudyCell& cell);

}  // namespace edgevo
