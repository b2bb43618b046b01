// SPDX-License-Identifier: BSD-3-Clause
#include "map_tables.h"

#include <zlib.h>

#include <cmath>
#include <cstdio>

#include "bytes_of_values.h"
#include "edgevo/core/formatted.h"

namespace edgevo {
namespace {

constexpr const char* kChecksum = "checksum";

std::string checksum_of(const MapTexts& texts) {
  uLong sum = 0;
  for (const auto& [name, text] : texts)
    for (const std::string& part : {name + "=", text + "\n"})
      sum = crc32(sum, reinterpret_cast<const Bytef*>(part.data()), uInt(part.size()));
  return std::to_string(sum);
}

bool is_usable(const Constraint& c) {
  if (!(c.T_from_to.scale > 0) || !std::isfinite(c.T_from_to.scale) || !c.T_from_to.rigid.is_finite())
    return false;
  return !c.covariance.hasNaN();
}

}  // namespace

void make_tables(Database* database) {
  database->execute(
      formatted("PRAGMA application_id=%d; PRAGMA user_version=%d", kMapApplication, kMapVersion));
  database->execute(
      "CREATE TABLE meta(name TEXT PRIMARY KEY, text TEXT NOT NULL);"
      "CREATE TABLE keyframes(id INTEGER PRIMARY KEY, place BLOB NOT NULL, view BLOB NOT NULL);"
      "CREATE TABLE constraints(number INTEGER PRIMARY KEY, data BLOB NOT NULL)");
}

void write_whole_map(const std::string& path, const std::function<void(Database*)>& fill) {
  Database target(path, Database::Access::kCreate);
  target.set_log("MEMORY");
  target.execute("PRAGMA page_size=4096; PRAGMA synchronous=FULL; BEGIN");
  make_tables(&target);
  fill(&target);
  target.execute("COMMIT");
}

Constraint in_new_units(Constraint c, double growth_from, double growth_to) {
  c.T_from_to.scale *= growth_from / growth_to;
  c.T_from_to.rigid = SE3(c.T_from_to.rigid.rotation(), growth_from * c.T_from_to.rigid.translation());
  c.covariance.topRows<3>() *= growth_from, c.covariance.leftCols<3>() *= growth_from;
  return c;
}

void write_texts(Database* database, const MapTexts& texts) {
  Statement put = database->statement("INSERT OR REPLACE INTO meta(name, text) VALUES(?, ?)");
  for (const auto& [name, text] : texts) put.bind_text(1, name).bind_text(2, text).execute();
  put.bind_text(1, kChecksum).bind_text(2, checksum_of(texts)).execute();
}

std::optional<MapTexts> read_texts(Database* database) {
  MapTexts texts;
  Statement rows = database->statement("SELECT name, text FROM meta");
  while (rows.step()) texts[std::string(rows.bytes(0))] = std::string(rows.bytes(1));
  const std::string stated = texts[kChecksum];
  texts.erase(kChecksum);
  if (stated != checksum_of(texts)) return std::nullopt;
  return texts;
}

KeyframeRows::KeyframeRows(Database* database)
    : put_(database->statement("INSERT OR REPLACE INTO keyframes(id, place, view) VALUES(?, ?, ?)")),
      remove_(database->statement("DELETE FROM keyframes WHERE id = ?")) {}

void KeyframeRows::put(int id, std::string_view place, std::string_view view) {
  put_.bind(1, id).bind_bytes(2, place).bind_bytes(3, view).execute();
}

void KeyframeRows::remove(int id) { remove_.bind(1, id).execute(); }

std::string bytes_of(const Constraint& constraint) {
  std::string bytes;
  append_value(&bytes, int32_t(constraint.from.number()));
  append_value(&bytes, int32_t(constraint.to.number()));
  append_value(&bytes, int32_t(constraint.kind));
  append_value(&bytes, constraint.T_from_to.scale);
  const Eigen::Quaterniond& q = constraint.T_from_to.rigid.rotation();
  for (const double v : {q.w(), q.x(), q.y(), q.z()}) append_value(&bytes, v);
  for (int i = 0; i < 3; ++i) append_value(&bytes, constraint.T_from_to.rigid.translation()[i]);
  for (int r = 0; r < 7; ++r)
    for (int c = 0; c <= r; ++c) append_value(&bytes, float(constraint.covariance(r, c)));
  PieceWriter out;
  out.add(bytes);
  return out.bytes();
}

std::optional<Constraint> read_constraint(std::string_view packed) {
  PieceReader pieces(packed);
  const std::string bytes = pieces.next();
  ValueReader in(bytes);
  Constraint constraint;
  constraint.from = NodeId::keyframe(in.value<int32_t>());
  constraint.to = NodeId::keyframe(in.value<int32_t>());
  const auto kind = in.value<int32_t>();
  if (kind < 0 || kind > int(ConstraintKind::kOperator)) return std::nullopt;
  constraint.kind = ConstraintKind(kind);
  double v[8];
  for (double& one : v) one = in.value<double>();
  constraint.T_from_to = {v[0], SE3(Eigen::Quaterniond(v[1], v[2], v[3], v[4]), {v[5], v[6], v[7]})};
  for (int r = 0; r < 7; ++r)
    for (int c = 0; c <= r; ++c)
      constraint.covariance(r, c) = constraint.covariance(c, r) = double(in.value<float>());
  if (!in.ok() || !is_usable(constraint)) return std::nullopt;
  return constraint;
}

ConstraintRows::ConstraintRows(Database* database)
    : put_(database->statement("INSERT OR REPLACE INTO constraints(number, data) VALUES(?, ?)")),
      remove_(database->statement("DELETE FROM constraints WHERE number = ?")) {}

void ConstraintRows::put(int64_t number, const Constraint& constraint) {
  const std::string bytes = bytes_of(constraint);
  put_.bind(1, number).bind_bytes(2, bytes).execute();
}

void ConstraintRows::remove(int64_t number) { remove_.bind(1, number).execute(); }

std::string to_text(const Pinhole& pinhole) {
  return formatted("%.17g %.17g %.17g %.17g %d %d", pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy,
                   pinhole.width, pinhole.height);
}

std::optional<Pinhole> pinhole_of(const std::string& text) {
  Pinhole p;
  if (std::sscanf(text.c_str(), "%lf %lf %lf %lf %d %d", &p.fx, &p.fy, &p.cx, &p.cy, &p.width, &p.height) !=
      6)
    return std::nullopt;
  constexpr int kMaxSide = 1 << 15;  // pixels
  const bool is_one =
      p.fx > 0 && p.fy > 0 && p.width > 0 && p.height > 0 && p.width <= kMaxSide && p.height <= kMaxSide;
  return is_one ? std::optional<Pinhole>(p) : std::nullopt;
}

}  // namespace edgevo
