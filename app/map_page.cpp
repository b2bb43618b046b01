// SPDX-License-Identifier: BSD-3-Clause
#include "map_page.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/output_file.h"
#include "edgevo/report/page.h"

namespace edgevo::app {
namespace {

constexpr int kPictures = 6;

using Rows = std::vector<std::vector<std::string>>;

std::string percent(double share) { return fixed(100 * share, 1) + " %"; }

std::vector<std::string> row_of(const MapFigure& m) {
  return {m.name,
          std::to_string(m.edges),
          m.edges > 0 ? percent(m.completeness()) : "",
          std::to_string(m.drawn),
          m.drawn > 0 ? percent(m.rightness()) : "",
          m.edges > 0 && m.drawn > 0 ? fixed(m.f(), 3) : ""};
}

std::string figures_table(const std::vector<MapFigure>& figures) {
  Rows rows;
  for (const MapFigure& m : figures)
    if (m.edges > 0 || m.drawn > 0) rows.push_back(row_of(m));
  return table_html({"", "edge pixels", "complete", "pixels of lines", "right", "F"}, rows);
}

std::string edges_table(const std::string& what, const std::vector<MapFigure>& figures) {
  Rows rows;
  for (const MapFigure& m : figures)
    if (m.edges > 0) rows.push_back({m.name, std::to_string(m.edges), percent(m.completeness())});
  return table_html({what, "edge pixels", "complete"}, rows);
}

std::string within(double near_m) {
  return std::isfinite(near_m) ? "Within " + fixed(near_m, 0) + " m of the camera." : "At all distances.";
}

// Shares of the edges of each class, and of all.
std::string causes_table(const MapFigures& f) {
  std::vector<std::string> header{"missing"};
  int64_t all = 0;
  for (const MapFigure& m : f.classes) {
    all += m.edges;
    if (m.edges > 0) header.push_back(m.name);
  }
  header.push_back("all");
  Rows rows;
  for (const MissingFigure& m : f.causes) {
    std::vector<std::string> row{to_string(m.cause)};
    for (size_t i = 0; i < f.classes.size(); ++i)
      if (f.classes[i].edges > 0) row.push_back(percent(double(m.edges[i]) / double(f.classes[i].edges)));
    row.push_back(percent(double(m.all()) / double(std::max<int64_t>(1, all))));
    rows.push_back(std::move(row));
  }
  return table_html(header, rows);
}

std::string pictures(const MapPage& page) {
  int last = 0;
  for (const KeyframeRecord& k : page.map.keyframes) last = std::max(last, k.frame_index);
  last = std::min(last, page.scene.size() - 1);
  std::string html = note_html(
      "Edges that a line of the map explains are green, missing ones red; lines that lie at no edge are "
      "blue. A click enlarges a picture.");
  for (int i = 0; i < kPictures; ++i) {
    const int frame = (2 * i + 1) * last / (2 * kPictures);
    const std::string png = map_picture_png(page.map, page.scene, frame);
    html += figure_html("png", {png.begin(), png.end()}, "the map over frame " + std::to_string(frame),
                        "frame " + std::to_string(frame));
  }
  return html;
}

std::string tiles(const MapFigures& f) {
  const auto near = std::find_if(f.bands.begin(), f.bands.end(), [&](const MapFigure& m) {
    return m.name == "within " + fixed(f.near_m, 0) + " m";
  });
  const MapFigure& m = near == f.bands.end() ? f.bands.back() : *near;
  return tiles_html({{percent(m.completeness()), "complete, " + m.name},
                     {percent(m.rightness()), "right, " + m.name},
                     {percent(f.bands.back().completeness()), "complete, all"},
                     {percent(f.bands.back().rightness()), "right, all"}});
}

}  // namespace

std::string map_page_html(const MapPage& page) {
  const MapFigures& f = page.figures;
  const std::string near = note_html(within(f.near_m));
  const std::string body =
      tiles(f) + section_html("pictures", "Map over images", pictures(page)) +
      section_html(
          "distance", "By distance",
          note_html("Complete: of the edge pixels that Canny sees, those with a line within two "
                    "pixels and 5 % of their depth. Right: of the lines in view, those at an edge.") +
              figures_table(f.bands)) +
      section_html("class", "By class", near + edges_table("class", f.classes)) +
      section_html("why", "Why edges are missing",
                   near + note_html("Shares of the edges of a class; the first cause that holds counts.") +
                       causes_table(f)) +
      section_html("place", "By place", near + figures_table(f.places)) +
      section_html("kind", "By kind and direction", near + edges_table("kind", f.kinds)) +
      section_html("source", "Lines by what their depth is from", figures_table(f.sources));
  return page_html("The map against its scene",
                   page.map_name + " in " + page.scene_name + ", seed " +
                       std::to_string(page.scene.scene().seed) + ": " + std::to_string(f.frames) +
                       " frames compared, " + fixed(f.metres_per_unit, 4) + " metres per unit",
                   body);
}

}  // namespace edgevo::app
