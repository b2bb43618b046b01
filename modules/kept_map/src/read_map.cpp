// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

#include "edgevo/core/error.h"
#include "edgevo/core/formatted.h"
#include "edgevo/core/input_file.h"
#include "edgevo/kept_map/kept_map.h"
#include "edgevo/kept_map/map_file_writer.h"
#include "final_map.h"
#include "keyframe_bytes.h"
#include "map_tables.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRemedy = "give the folder of a run, or its map.db";
constexpr std::string_view kMagic("SQLite format 3\0", 16);
// Where the first bytes of a database hold the version of its tables and the kind of what is in it.
constexpr size_t kVersionAt = 60, kApplicationAt = 68, kHeadBytes = 100;

std::string head_of(const std::string& path) {
  std::string head(kHeadBytes, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), std::streamsize(head.size()));
  head.resize(size_t(in.gcount()));
  return head;
}

// Big-endian, as SQLite writes it.
int64_t number_at(const std::string& head, size_t at) {
  int64_t value = 0;
  for (size_t i = at; i < at + 4; ++i) value = value << 8 | uint8_t(head[i]);
  return value;
}

void check_kind(const std::string& path) {
  check_regular_file(path, kRemedy);
  const std::string head = head_of(path);
  if (head.empty()) throw InputError(path, "is empty", kRemedy);
  if (head.size() < kHeadBytes || std::string_view(head).substr(0, kMagic.size()) != kMagic)
    throw InputError(path, "is no map", kRemedy);
  if (number_at(head, kApplicationAt) != kMapApplication)
    throw InputError(path, "is a database of something else", kRemedy);
  const int64_t version = number_at(head, kVersionAt);
  if (version > kMapVersion)
    throw InputError(path,
                     "is a map of version " + std::to_string(version) + ", this edgevo reads up to " +
                         std::to_string(kMapVersion),
                     "read it with the edgevo that wrote it, or a newer one");
}

// The log of a run that was killed holds its last keyframes, and SQLite reads it only together with files
// that it writes next to it: in a folder of its own then, with copies.
class UnchangedFile {
 public:
  explicit UnchangedFile(const std::string& path) : path_(path) {
    const std::string log = path + "-wal";
    std::error_code error;
    if (fs::file_size(log, error) == 0 || error) return;
    make_folder();
    path_ = (folder_ / kMapFile).string();
    copy(path, path_);
    copy(log, path_ + "-wal");
  }
  ~UnchangedFile() {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
  }
  UnchangedFile(const UnchangedFile&) = delete;
  UnchangedFile& operator=(const UnchangedFile&) = delete;

  Database open() const {
    if (folder_.empty()) return {path_, Database::Access::kUnchanging};
    Database(path_, Database::Access::kWrite).set_log("DELETE");  // takes in what is in the log
    return {path_, Database::Access::kUnchanging};
  }

 private:
  void make_folder() {
    std::string name = (fs::temp_directory_path() / "edgevo_map_XXXXXX").string();
    if (!mkdtemp(name.data())) throw InputError(name, "cannot be made", "check the temporary folder");
    folder_ = name;
  }
  static void copy(const std::string& from, const std::string& to) {
    std::error_code error;
    if (!fs::copy_file(from, to, error))
      throw InputError(from, "cannot be copied to " + to + ": " + error.message(), "free space there");
  }

  std::string path_;
  fs::path folder_;
};

bool is_within(const Pinhole& pinhole, const RememberedView& view) {
  const Pinhole& level = view.edges.pinhole;
  return level.width > 0 && level.height > 0 && level.width <= pinhole.width &&
         level.height <= pinhole.height && level.fx > 0 && level.fy > 0;
}

// Reads row by row, on behind damage.
class MapReader {
 public:
  MapReader(Database* database, const std::string& path)
      : database_(database),
        path_(path),
        motion_(database->statement("SELECT data FROM constraints WHERE number = ?")) {}

  KeptMap read() {
    KeptMap map = described();
    read_keyframes(&map);
    read_constraints(&map);
    warn(&map);
    if (map.store.size() == 0 && damaged_ > 0)
      throw InputError(path_, "has no keyframe that is whole", "record the map again, or look for a copy");
    return map;
  }

 private:
  KeptMap described() {
    const std::optional<MapTexts> found = read_texts(database_);
    const std::optional<Pinhole> pinhole = found ? pinhole_of(text(*found, "pinhole")) : std::nullopt;
    if (!pinhole)
      throw InputError(path_, "its description is damaged", "record the map again, or look for a copy");
    KeptMap map({*pinhole, text(*found, "camera"), text(*found, "source")});
    map.is_finished = text(*found, "finished") == "1";
    if (!map.is_finished) return map;
    map.scale_source = text(*found, "scale_source");
    map.scale_sigma = std::atof(text(*found, "scale_sigma").c_str());
    ImageCorrection& lens = map.correction;
    std::sscanf(text(*found, "correction").c_str(), "%lf %lf %lf", &lens.k1, &lens.readout_s, &lens.focal);
    return map;
  }
  static std::string text(const MapTexts& texts, const std::string& name) {
    const auto found = texts.find(name);
    return found == texts.end() ? "" : found->second;
  }

  // Calls `take` with each row whose first column, a whole number, is not below 0, in that order; rows that
  // SQLite cannot read are skipped.
  template <class Take>
  void each_row(const std::string& columns, const std::string& table, const Take& take) {
    constexpr int kMaxFailures = 2000;  // in a row: the rest is gone
    const std::string key = columns.substr(0, columns.find(','));
    Statement row = database_->statement("SELECT " + columns + " FROM " + table + " WHERE " + key +
                                         " >= ? ORDER BY " + key + " LIMIT 1");
    int failures = 0;
    for (int64_t at = 0; failures < kMaxFailures;) try {
        row.reset();
        if (!row.bind(1, at).step() || row.integer(0) < at) break;
        at = row.integer(0);
        take(row);
        failures = 0;
        ++at;
      } catch (const DatabaseError&) {
        is_cut_ = true;
        ++failures, ++at;
      }
    row.reset();
  }

  void read_constraints(KeptMap* map) {
    each_row("number, data", "constraints", [&](const Statement& row) {
      const std::optional<Constraint> c = read_constraint(row.bytes(1));
      c ? map->constraints.push_back(*c) : void(++damaged_constraints_);
    });
  }

  // The motion from a keyframe to the next; nothing if it is not known or damaged.
  std::optional<NeighbourPose> motion_of(int id) try {
    motion_.reset();
    if (!motion_.bind(1, number_of_motion(id)).step()) return std::nullopt;
    const std::optional<Constraint> c = read_constraint(motion_.bytes(0));
    if (c && c->from == NodeId::keyframe(id)) return neighbour_of(*c);
    ++damaged_constraints_;
    return std::nullopt;
  } catch (const DatabaseError&) {
    is_cut_ = true;
    return std::nullopt;
  }

  void read_keyframes(KeptMap* map) {
    each_row("id, place, view", "keyframes", [&](const Statement& row) {
      std::optional<KeyframePlace> place = read_place(row.bytes(1));
      std::optional<RememberedView> view = read_view(row.bytes(2));
      if (!place || !view || place->id != row.integer(0) || !is_within(map->header.pinhole, *view))
        return void(++damaged_);
      map->store.add({place->id, place->epoch,
                      std::make_shared<const KeyframeRecord>(std::move(place->record)),
                      std::make_shared<const RememberedView>(std::move(*view)), motion_of(place->id)});
    });
  }

  void warn(KeptMap* map) const {
    const std::string kept = ", the other " + std::to_string(map->store.size()) + " are used";
    if (damaged_ > 0)
      map->warnings.push_back(path_ + ": " + std::to_string(damaged_) + " keyframes are damaged" + kept);
    if (is_cut_)
      map->warnings.push_back(path_ + ": the file is damaged or cut off; " +
                              std::to_string(map->store.size()) + " keyframes could be read");
    if (damaged_constraints_ > 0)
      map->warnings.push_back(path_ + ": " + std::to_string(damaged_constraints_) +
                              " relations of keyframes are damaged, and not used");
    if (!map->is_finished)
      map->warnings.push_back(path_ +
                              ": the run has not come to its end; its places are as they were found "
                              "first, `edgevo finish` writes the final ones");
  }

  Database* const database_;
  const std::string& path_;
  Statement motion_;
  int damaged_ = 0, damaged_constraints_ = 0;
  bool is_cut_ = false;
};

}  // namespace

bool names_map(const std::string& path) {
  if (fs::path(path).filename() == kMapFile) return true;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;  // a pipe may block
  const std::string head = head_of(path);
  return head.size() == kHeadBytes && std::string_view(head).substr(0, kMagic.size()) == kMagic &&
         number_at(head, kApplicationAt) == kMapApplication;
}

KeptMap read_map(const std::string& path) {
  check_kind(path);
  try {
    const UnchangedFile file(path);
    Database database = file.open();
    return MapReader(&database, path).read();
  } catch (const DatabaseError& e) {
    throw InputError(path, std::string("is damaged (") + e.what() + ")",
                     "record the map again, or look for a copy");
  }
}

std::string map_file_of(const std::string& path) {
  return fs::is_directory(path) ? (fs::path(path) / kMapFile).string() : path;
}

namespace {

void check_finished(const KeptMap& map, const std::string& file) {
  if (!map.is_finished)
    throw InputError(file, "was left by a run that did not end: its places are not final",
                     "`edgevo finish` with the folder of that run ends it");
  if (map.store.keyframes().empty())
    throw InputError(file, "has no keyframe that can be read: it is damaged, cut off or empty",
                     "give the map of another run");
}

}  // namespace

KeptMap read_finished_map(const std::string& path) {
  const std::string file = map_file_of(path);
  KeptMap map = read_map(file);
  check_finished(map, file);
  return map;
}

KeptMap read_finished_map(const std::string& path, const Pinhole& pinhole) {
  const std::string file = map_file_of(path);
  KeptMap map = read_map(file);
  check_camera(map, pinhole, file);
  check_finished(map, file);
  map.store.number_epochs({});  // at its end a run has one unit
  return map;
}

void check_camera(const KeptMap& map, const Pinhole& pinhole, const std::string& path) {
  const Pinhole& of_map = map.header.pinhole;
  // A camera calibrated twice differs by less.
  constexpr double kMaxDifference = 0.02;  // of the focal length
  const double limit = kMaxDifference * of_map.fx;
  const bool is_same = of_map.width == pinhole.width && of_map.height == pinhole.height &&
                       std::abs(of_map.fx - pinhole.fx) < limit && std::abs(of_map.fy - pinhole.fy) < limit &&
                       std::abs(of_map.cx - pinhole.cx) < limit && std::abs(of_map.cy - pinhole.cy) < limit;
  if (is_same) return;
  const auto said = [](const Pinhole& p) {
    return formatted("%dx%d, focal length %.0f %.0f, centre %.0f %.0f px", p.width, p.height, p.fx, p.fy,
                     p.cx, p.cy);
  };
  throw InputError(
      path, "was made by another camera (rectified " + said(of_map) + "; the source: " + said(pinhole) + ")",
      "give a map of this camera, or the same --camera and --image-scale");
}

}  // namespace edgevo
