#include "edgevo/study/study_report.h"

#include "edgevo/core/output_file.h"
#include "study_tables.h"

namespace edgevo {

void write_study(const StudyResult& result, const std::string& folder) {
  make_output_folder(folder);
  for (const char* curve : {"search_length", "patch_size", "frame_distance", "residuals"})
    write_file(folder + "/" + curve + ".csv", curve_table(result, curve));
  write_file(folder + "/end_point_error.csv", end_point_table(result));
  write_file(folder + "/confidence.csv", confidence_table(result));
  write_file(folder + "/confidence_areas.csv", confidence_area_table(result));
}

bool draw_plots(const std::string&) { return false; }

}  // namespace edgevo
