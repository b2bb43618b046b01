// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/servo/servo_outputs.h"

#include <algorithm>
#include <functional>

#include "edgevo/core/output_file.h"
#include "servo_charts.h"
#include "servo_report.h"
#include "servo_views.h"

namespace edgevo {
namespace {

const char* name_of(Phase phase) {
  switch (phase) {
    case Phase::kTeach:
      return "teach";
    case Phase::kAway:
      return "away";
    case Phase::kServo:
      return "servo";
  }
  return "";
}

std::string one_cell(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '"' || c == '\n'; }, ';');
  return text;
}

std::string as_text(const std::vector<uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

std::string servo_csv(const ServoResult& result) {
  std::string text =
      "time,phase,state,age_ms,latency_ms,true_mm,true_deg,seen_mm,seen_deg,seen_px,vx,vy,vz,wx,wy,wz,x,y,z,"
      "qx,qy,qz,qw,stop\n";
  for (const ServoRow& row : result.rows) {
    text += fixed(row.time_s, 4) + ',' + name_of(row.phase) + ',' + std::string(to_string(row.state));
    const Command& c = row.command;
    for (double v : {1000 * row.age_s, 1000 * row.latency_s, row.true_mm, row.true_deg,
                     1000 * c.translation_m, c.rotation_deg, c.image_px})
      append_fixed(&(text += ','), v, 4);
    for (unsigned i = 0; i < 6; ++i) append_fixed(&(text += ','), c.velocity[i], 6);
    for (int i = 0; i < 3; ++i) append_fixed(&(text += ','), row.T_scene_cam.translation()[i], 6);
    for (int i = 0; i < 4; ++i) append_fixed(&(text += ','), row.T_scene_cam.rotation().coeffs()[i], 8);
    text += ',' + one_cell(c.stop) + '\n';
  }
  return text;
}

void write_servo_outputs(const ServoResult& result, const ServoRunInfo& info, RunFolder* folder) {
  const auto write = [&](const std::string& file, const std::function<std::string()>& text) {
    folder->attempt(file, [&](const std::string& path) { write_file(path, text()); });
  };
  write("servo.csv", [&] { return servo_csv(result); });
  write("summary.yaml", [&] { return servo_summary(result, info) + "odometry:\n" + info.params_yaml; });
  const std::vector<ServoView> views = views_of(result);
  for (const ServoView& v : views) write(v.name + ".png", [&] { return as_text(v.png); });
  if (!result.points_start.empty())
    write("convergence.svg", [&] { return convergence_svg(result, info.params); });
  write("report.html", [&] { return servo_report(result, info, views); });
  if (result.kept)
    folder->attempt("goal.txt", [&](const std::string&) { write_kept_loop(*result.kept, folder->path()); });
  folder->throw_first_failure();
}

}  // namespace edgevo
