// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/survey_export.h"

#include <ctime>
#include <mutex>
#include <thread>

#include "edgevo/core/error.h"
#include "edgevo/core/run_parallel.h"

namespace edgevo {
namespace {

// Noon of a date YYMMDD, UTC.
Timestamp noon_of(const std::string& survey) {
  std::tm date{};
  date.tm_year = 100 + std::stoi(survey.substr(0, 2));
  date.tm_mon = std::stoi(survey.substr(2, 2)) - 1;
  date.tm_mday = std::stoi(survey.substr(4, 2));
  date.tm_hour = 12;
  return Timestamp::from_seconds(double(timegm(&date)));
}

std::string note_of(const Scene& scene, const SurveyLocation& location, int begin, int end) {
  return "# Rendered survey `" + location.name + "`\n\nScene `" + scene.name + "`, seed " +
         std::to_string(scene.seed) + ", frames " + std::to_string(begin) + ":" + std::to_string(end) +
         ", in the layout of Symphony Lake. Rendered by edgevo; nothing in it was photographed or taken from "
         "others.\n";
}

}  // namespace

std::string usual_survey_name(const std::string& season) {
  if (season == "spring") return "150415";
  if (season == "autumn") return "151015";
  if (season == "winter") return "160115";
  return "150715";  // in full leaf, as a scene without a season is
}

void write_survey(const SceneRenderer& renderer, const SurveyLocation& location, int begin, int end,
                  const std::function<void(int)>& on_frame_done) {
  const Scene& scene = renderer.scene();
  if (begin < 0 || begin >= end || end > scene.size())
    throw InputError("scene " + scene.name,
                     "frames " + std::to_string(begin) + ":" + std::to_string(end) + " are not in it",
                     "it has frames 0:" + std::to_string(scene.size()));
  const SurveyWriter writer(location, scene.camera);
  const Timestamp noon = noon_of(location.name);
  std::mutex mutex;
  int done = 0;
  run_parallel(begin, end, int(std::max(1u, std::thread::hardware_concurrency())), [&](int i) {
    writer.write_image(i, renderer.render_image(i));
    const std::lock_guard<std::mutex> lock(mutex);
    on_frame_done(++done);
  });
  std::vector<SurveyFrame> frames;
  for (int i = begin; i < end; ++i)
    frames.push_back({i, Timestamp{noon.ticks + scene.times[size_t(i)].ticks}, scene.T_scene_cam[size_t(i)]});
  writer.finish(frames, note_of(scene, location, begin, end));
}

}  // namespace edgevo
