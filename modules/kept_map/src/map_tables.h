// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tables of a map file: what is in which column, for those who write and those who read it.
//
// keyframes: a row each, its place and its view as in keyframe_bytes.h. constraints: a row each. meta: texts
// by name, with a checksum of them all.
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "database.h"
#include "edgevo/core/camera.h"
#include "edgevo/map/map_graph.h"

namespace edgevo {

/// Number that says what kind of database it is, "EvMp", and the version of its tables.
constexpr int32_t kMapApplication = 0x45764D70, kMapVersion = 1;

/// The texts of the table meta, by name.
using MapTexts = std::map<std::string, std::string>;

/// Makes the tables in a new database.
void make_tables(Database* database);
/// Writes a whole file at once: `fill` gets it with its tables. Throws DatabaseError.
void write_whole_map(const std::string& path, const std::function<void(Database*)>& fill);
/// Replaces the texts, in a transaction of the caller.
void write_texts(Database* database, const MapTexts& texts);
/// The texts; nothing if they are damaged. Throws DatabaseError.
std::optional<MapTexts> read_texts(Database* database);

/// Appends, replaces or removes rows of keyframes.
class KeyframeRows {
 public:
  /// Throws DatabaseError, as all below.
  explicit KeyframeRows(Database* database);
  /// Writes a row.
  void put(int id, std::string_view place, std::string_view view);
  /// Removes a row, if there is one.
  void remove(int id);

 private:
  Statement put_, remove_;
};

/// A constraint as bytes: nodes, kind, motion, covariance.
std::string bytes_of(const Constraint& constraint);
/// The constraint back, without what else may hold; nothing if the bytes are damaged.
std::optional<Constraint> read_constraint(std::string_view bytes);
/// The constraint where the lengths around its two keyframes have become this many times as long.
Constraint in_new_units(Constraint c, double growth_from, double growth_to);
/// Appends or replaces rows of constraints.
class ConstraintRows {
 public:
  /// Throws DatabaseError, as all below.
  explicit ConstraintRows(Database* database);
  /// Writes a row.
  void put(int64_t number, const Constraint& constraint);
  /// Removes a row.
  void remove(int64_t number);

 private:
  Statement put_, remove_;
};

/// A pinhole as text, exactly, and back; nothing if it is none.
std::string to_text(const Pinhole& pinhole);
std::optional<Pinhole> pinhole_of(const std::string& text);

}  // namespace edgevo
