// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/kept_map/map_file_writer.h"

#include <optional>

#include "final_map.h"
#include "keyframe_bytes.h"
#include "map_file.h"
#include "map_tables.h"

namespace edgevo {
namespace {

// A file of this name has all tables, whenever the program is killed.
void make_file(const std::string& path, const MapHeader& header) {
  remove_map_files(path);
  remove_map_files(name_while_made(path));
  {
    Database database(name_while_made(path), Database::Access::kCreate);
    database.set_log("MEMORY");
    database.execute("PRAGMA page_size=4096; BEGIN");
    make_tables(&database);
    write_texts(&database, texts_of(header));
    database.execute("COMMIT");
  }
  take_its_name(path);
}

}  // namespace

const std::vector<std::string>& map_file_names() {
  static const std::vector<std::string> names{kMapFile, "map.db-wal", "map.db-shm", "map.db.new"};
  return names;
}

struct MapFileWriter::Impl {
  explicit Impl(const std::string& where)
      : path(where), database(std::in_place, where, Database::Access::kWrite) {
    // What is committed survives the death of the program; each checkpoint that of the machine.
    database->set_log("WAL");
    database->execute("PRAGMA synchronous=NORMAL");
    keyframes.emplace(&*database);
    constraints.emplace(&*database);
  }

  // Each call is one transaction: a write to SQLite's log.
  template <class Write>
  void transact(const Write& write) {
    database->execute("BEGIN");
    write();
    database->execute("COMMIT");
  }
  void close() {
    constraints.reset();
    keyframes.reset();
    database.reset();
  }

  std::string path;
  std::optional<Database> database;
  std::optional<KeyframeRows> keyframes;
  std::optional<ConstraintRows> constraints;
};

namespace {

template <class Work>
void attempt(const std::string& path, const Work& work) {
  attempt_writing(path, "free space or give another -o; the map so far is kept", work);
}

}  // namespace

MapFileWriter::MapFileWriter(const std::string& path, const MapHeader& header) {
  attempt(path, [&] {
    make_file(path, header);
    impl_ = std::make_unique<Impl>(path);
  });
}

MapFileWriter::MapFileWriter(const std::string& path) {
  attempt(path, [&] { impl_ = std::make_unique<Impl>(path); });
}

MapFileWriter::~MapFileWriter() = default;

void MapFileWriter::add(const StoredKeyframe& keyframe) {
  if (!keyframe.view || keyframe.record->is_doubtful)
    return attempt(impl_->path, [&] { impl_->keyframes->remove(keyframe.id); });
  const std::string place = bytes_of(KeyframePlace{keyframe.id, keyframe.epoch, *keyframe.record}),
                    view = bytes_of(*keyframe.view);
  attempt(impl_->path, [&] {
    impl_->transact([&] {
      impl_->keyframes->put(keyframe.id, place, view);
      if (keyframe.next) impl_->constraints->put(number_of_motion(keyframe.id), motion_of(keyframe));
    });
  });
}

void MapFileWriter::add(const ConstraintAdded& added) {
  const auto is_keyframe = [](const NodeId& node) { return node.kind() == NodeId::Kind::kKeyframe; };
  if (!is_keyframe(added.constraint.from) || !is_keyframe(added.constraint.to)) return;
  attempt(impl_->path, [&] { impl_->constraints->put(added.id, added.constraint); });
}

void MapFileWriter::withdraw(int constraint) {
  attempt(impl_->path, [&] { impl_->constraints->remove(constraint); });
}

void MapFileWriter::finish(const Run& run) {
  const std::string fresh = name_while_made(impl_->path);
  remove_map_files(fresh);
  attempt(impl_->path, [&] {
    write_final_map(&*impl_->database, run, fresh);
    impl_->close();
  });
  take_its_name(impl_->path);
}

}  // namespace edgevo
