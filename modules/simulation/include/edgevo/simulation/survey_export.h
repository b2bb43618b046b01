#pragma once
// A rendered scene as a survey in the layout of Symphony Lake.
#include <functional>
#include <string>

#include "edgevo/simulation/scene_renderer.h"
#include "edgevo/symphony_lake/survey_writer.h"

namespace edgevo {

/// The date that a rendered survey has where the user names none: the middle of its scene's season.
std::string usual_survey_name(const std::string& season);

/// Frames begin <= index < end, from noon (UTC) of the survey's date on. Throws InputError. `on_frame_done`
/// is told how many are done, one call at a time.
void write_survey(const SceneRenderer& renderer, const SurveyLocation& location, int begin, int end,
                  const std::function<void(int)>& on_frame_done);

}  // namespace edgevo
