// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/correspondence_export.h"

#include <cstdio>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/simulation/correspondence.h"

namespace edgevo {
namespace {

void append_row(std::string* text, const Eigen::Vector2d& edge, const Correspondence& c) {
  append_fixed(text, edge.x(), 3);
  *text += ",";
  append_fixed(text, edge.y(), 3);
  *text += ",";
  if (c.in_view) append_fixed(text, c.px.x(), 3);
  *text += ",";
  if (c.in_view) append_fixed(text, c.px.y(), 3);
  *text += c.visible ? ",1\n" : ",0\n";
}

std::string rows_of(const std::vector<Eigen::Vector2d>& edges, const ViewPair& views) {
  std::string text = "x,y,x_next,y_next,visible\n";
  for (const Eigen::Vector2d& edge : edges) append_row(&text, edge, find_correspondence(views, edge));
  return text;
}

std::string numbered(const std::string& folder, int index) {
  char name[32];
  std::snprintf(name, sizeof name, "/%06d.csv", index);
  return folder + name;
}

}  // namespace

void export_correspondences(const SceneRenderer& renderer, const std::string& folder, int begin, int end,
                            const EdgePixelFinder& find_edges, const std::function<void(int)>& on_pair_done) {
  if (begin < 0 || end > renderer.size() || end - begin < 2)
    throw InputError("scene " + renderer.scene().name, "correspondences need two frames of it",
                     "it has frames 0:" + std::to_string(renderer.size()));
  if (renderer.scene().shutter.rolling_s > 0)
    throw InputError(
        "scene " + renderer.scene().name,
        "with a rolling shutter its rows have poses of their own: correspondences would not be exact",
        "leave the rolling shutter out");
  make_output_folder(folder + "/correspondences");
  const int width = renderer.undistorted().width, height = renderer.undistorted().height;
  std::vector<float> depth = renderer.render_depth(begin);
  for (int i = begin; i + 1 < end; ++i) {
    const std::vector<float> next = renderer.render_depth(i + 1);
    const ViewPair views{renderer.undistorted(),
                         {depth.data(), width, height, width},
                         {next.data(), width, height, width},
                         renderer.T_world_cam(i + 1).inverse() * renderer.T_world_cam(i)};
    write_file(numbered(folder + "/correspondences", i),
               rows_of(find_edges(renderer.render_image(i)), views));
    depth = next;
    if (on_pair_done) on_pair_done(i + 1 - begin);
  }
}

}  // namespace edgevo
