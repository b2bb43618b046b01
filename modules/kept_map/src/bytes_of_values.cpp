// SPDX-License-Identifier: BSD-3-Clause
#include "bytes_of_values.h"

#include <zstd.h>

#include <memory>
#include <stdexcept>

namespace edgevo {
namespace {

// Twice the time of the usual level for 3 % fewer bytes: they are read more often than written.
constexpr int kLevel = 6;
// Larger than any piece: a damaged size costs no memory.
constexpr unsigned long long kMaxPiece = 1 << 24;
// Stands for a number that does not fit into a byte.
constexpr uint8_t kEscape = 255;

using Compressor = std::unique_ptr<ZSTD_CCtx, size_t (*)(ZSTD_CCtx*)>;

// Made once a thread: it has a megabyte of tables.
ZSTD_CCtx* compressor() {
  static thread_local const Compressor context = [] {
    Compressor made(ZSTD_createCCtx(), ZSTD_freeCCtx);
    ZSTD_CCtx_setParameter(made.get(), ZSTD_c_compressionLevel, kLevel);
    ZSTD_CCtx_setParameter(made.get(), ZSTD_c_checksumFlag, 1);
    return made;
  }();
  return context.get();
}

// 0, -1, 1, -2, ... as 0, 1, 2, 3, ...
unsigned folded(int value) { return (unsigned(value) << 1) ^ unsigned(value >> 31); }
int unfolded(unsigned value) { return int(value >> 1) ^ -int(value & 1); }

}  // namespace

void PieceWriter::add(std::string_view bytes) {
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  const size_t size = ZSTD_compress2(compressor(), frame.data(), frame.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size)) throw std::runtime_error(ZSTD_getErrorName(size));
  append_value(&packed_, uint32_t(size));
  packed_.append(frame.data(), size);
}

void PieceWriter::add(const std::vector<uint16_t>& values) {
  std::string lower, upper;
  for (const uint16_t v : values) lower += char(v & 255), upper += char(v >> 8);
  add(lower);
  add(upper);
}

void PieceWriter::add_small(const std::vector<int>& values) {
  std::string small, large;
  for (const int v : values) {
    const bool fits = folded(v) < kEscape;
    small += char(fits ? folded(v) : kEscape);
    if (!fits) append_value(&large, v);
  }
  add(small);
  add(large);
}

std::string PieceReader::next() {
  const auto size = packed_.value<uint32_t>();
  const std::string_view frame = packed_.take(size);
  const unsigned long long stated = ZSTD_getFrameContentSize(frame.data(), frame.size());
  ok_ = ok_ && packed_.ok() && !frame.empty() && stated <= kMaxPiece;
  if (!ok_) return {};
  std::string bytes(size_t(stated), '\0');
  ok_ = ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size()) == bytes.size();
  return bytes;
}

std::vector<uint16_t> PieceReader::next_16(size_t count) {
  const std::string lower = next(), upper = next();
  ok_ = ok_ && lower.size() == count && upper.size() == count;
  std::vector<uint16_t> values;
  for (size_t i = 0; ok_ && i < count; ++i)
    values.push_back(uint16_t(uint8_t(lower[i]) | uint8_t(upper[i]) << 8));
  return values;
}

std::vector<int> PieceReader::next_small(size_t count) {
  const std::string small = next(), large = next();
  ok_ = ok_ && small.size() == count;
  ValueReader others(large);
  std::vector<int> values;
  for (size_t i = 0; ok_ && i < count; ++i)
    values.push_back(uint8_t(small[i]) == kEscape ? others.value<int>() : unfolded(uint8_t(small[i])));
  ok_ = ok_ && others.ok();
  return values;
}

}  // namespace edgevo
