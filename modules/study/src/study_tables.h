#pragma once
// The tables of a study as text.
#include <string>

#include "edgevo/study/study.h"

namespace edgevo {

/// search_length.csv and its like: one row a cell.
std::string curve_table(const StudyResult& result, const std::string& curve);
/// end_point_error.csv: single matches of the curve "residuals".
std::string end_point_table(const StudyResult& result);
/// match_errors.csv: distribution of the end-point errors behind it, 100 steps from 0.02 to 200 pixels.
std::string match_error_table(const StudyResult& result);
/// confidence.csv (at most 200 rows a curve) and confidence_areas.csv.
std::string confidence_table(const StudyResult& result);
std::string confidence_area_table(const StudyResult& result);

/// The measures of a cell of the curve "confidence": C_m against the end-point error of photometric matches,
/// C_d against the depth error of edge matches. Both thresholds are kWrongMatchPx.
ConfidenceCurve confidence_curve(const StudyCell& cell);

}  // namespace edgevo
