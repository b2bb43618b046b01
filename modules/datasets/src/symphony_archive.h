#pragma once
// Symphony Lake's archive: where its surveys and their maps lie.
//
//   ARCHIVE/VBags/SURVEY/image_auxilliary.csv          older copies
//   ARCHIVE/Dataset/20YY/SURVEY/image_auxilliary.csv   newer ones
//   ARCHIVE/Maps/SURVEY/optposes.csv
// A survey is named by its date, YYMMDD, sometimes with a letter behind. ARCHIVE may also be VBags or Dataset
// itself.
#include <string>
#include <vector>

#include "edgevo/datasets/surveys.h"

namespace edgevo {

/// The survey's folder where `path` is ARCHIVE/SURVEY, or an archive with a single survey; `path` itself
/// where it is neither. Throws InputError: an archive with several surveys (it lists them), two surveys of
/// that name, none of it.
std::string survey_folder(const std::string& path);

/// Maps/SURVEY/optposes.csv of a survey's folder, looked for in the three folders above it; empty if there is
/// none.
std::string survey_map(const std::string& survey_folder);

/// Name of the survey that lies in a folder.
std::string survey_name(const std::string& survey_folder);

}  // namespace edgevo
