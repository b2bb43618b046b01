// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "edgevo/map_evaluation/map_figures.h"

namespace edgevo {
namespace {

template <class... Values>
std::string formatted_row(const char* format, Values... values) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

std::string json_band(const MapFigure& m) {
  return formatted_row(
      "{\"name\": \"%s\", \"edges\": %lld, \"complete\": %.4f, \"lines\": %lld, \"right\": %.4f, \"f\": "
      "%.4f}",
      m.name.c_str(), (long long)m.edges, m.completeness(), (long long)m.drawn, m.rightness(), m.f());
}

std::string table_row(const MapFigure& m) {
  if (m.edges == 0 && m.drawn == 0) return "";
  return formatted_row("%-20s %10lld %9.3f %10lld %7.3f %6.3f\n", m.name.c_str(), (long long)m.edges,
                       m.completeness(), (long long)m.drawn, m.rightness(), m.f());
}

// Lines have no kind.
std::string json_kind(const MapFigure& m) {
  return formatted_row("{\"name\": \"%s\", \"edges\": %lld, \"complete\": %.4f}", m.name.c_str(),
                       (long long)m.edges, m.completeness());
}

// Edges have no source.
std::string json_source(const MapFigure& m) {
  return formatted_row("{\"name\": \"%s\", \"lines\": %lld, \"right\": %.4f}", m.name.c_str(),
                       (long long)m.drawn, m.rightness());
}

int64_t edges_of(const std::vector<MapFigure>& classes) {
  int64_t all = 0;
  for (const MapFigure& m : classes) all += m.edges;
  return all;
}

double share_of(int64_t part, int64_t all) { return all > 0 ? double(part) / double(all) : 0; }

std::string json_cause(const MissingFigure& m, int64_t all) {
  std::string by_class;
  for (size_t i = 0; i < m.edges.size(); ++i)
    if (m.edges[i] > 0)
      by_class += formatted_row("%s\"%s\": %lld", by_class.empty() ? "" : ", ", to_string(Thing(i)).c_str(),
                                (long long)m.edges[i]);
  return formatted_row("{\"name\": \"%s\", \"edges\": %lld, \"share\": %.4f, \"by_class\": {",
                       to_string(m.cause).c_str(), (long long)m.all(), share_of(m.all(), all)) +
         by_class + "}}";
}

template <class Figures, class F>
std::string json_list(const Figures& figures, const F& to_json) {
  std::string text;
  for (const auto& m : figures) text += (text.empty() ? "\n    " : ",\n    ") + to_json(m);
  return "[" + text + "\n  ]";
}

}  // namespace

const std::string& to_string(MissingCause cause) {
  static const std::string words[kMissingCauses] = {
      "a line at another depth", "seen in few frames", "too far away",
      "along the motion",        "a short edge",       "no line of it"};
  return words[size_t(cause)];
}

std::string to_table(const MapFigures& figures) {
  std::string text = formatted_row(
      "%d frames compared; %.6g metres per unit of the map\n\n%-20s %10s %9s %10s %7s %6s\n", figures.frames,
      figures.metres_per_unit, "edges", "pixels", "complete", "line px", "right", "F");
  for (const MapFigure& m : figures.bands) text += table_row(m);
  for (const MapFigure& m : figures.sources)
    if (m.drawn > 0)
      text += formatted_row("%-20s %10s %9s %10lld %7.3f\n", ("by " + m.name).c_str(), "", "",
                            (long long)m.drawn, m.rightness());
  text += std::isfinite(figures.near_m) ? formatted_row("\nwithin %g m:\n", figures.near_m) : "\n";
  for (const MapFigure& m : figures.places) text += table_row(m);
  for (const MapFigure& m : figures.kinds)
    text += formatted_row("%-20s %10lld %9.3f\n", m.name.c_str(), (long long)m.edges, m.completeness());
  text += "\n";
  for (const MapFigure& m : figures.classes)
    if (m.edges > 0)
      text += formatted_row("%-20s %10lld %9.3f\n", m.name.c_str(), (long long)m.edges, m.completeness());
  if (!figures.causes.empty()) text += "\nmissing there, of all edges:\n";
  for (const MissingFigure& m : figures.causes)
    text += formatted_row("%-23s %7lld %9.3f\n", to_string(m.cause).c_str(), (long long)m.all(),
                          share_of(m.all(), edges_of(figures.classes)));
  return text;
}

std::string to_json(const MapFigures& figures) {
  const std::string near = std::isfinite(figures.near_m) ? formatted_row("%g", figures.near_m) : "null";
  const auto cause = [&](const MissingFigure& m) { return json_cause(m, edges_of(figures.classes)); };
  return formatted_row("{\n  \"frames\": %d, \"metres_per_unit\": %.9g, \"near_m\": %s,\n  \"bands\": ",
                       figures.frames, figures.metres_per_unit, near.c_str()) +
         json_list(figures.bands, json_band) + ",\n  \"kinds\": " + json_list(figures.kinds, json_kind) +
         ",\n  \"places\": " + json_list(figures.places, json_band) +
         ",\n  \"classes\": " + json_list(figures.classes, json_kind) +
         ",\n  \"causes\": " + json_list(figures.causes, cause) +
         ",\n  \"sources\": " + json_list(figures.sources, json_source) + "\n}\n";
}

}  // namespace edgevo
