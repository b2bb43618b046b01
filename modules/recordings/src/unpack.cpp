// SPDX-License-Identifier: BSD-3-Clause
#include "unpack.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

#include "edgevo/core/output_file.h"
#include "edgevo/recordings/recording.h"
#include "printable.h"
#include "random_file.h"

namespace edgevo {
namespace {

[[noreturn]] void fail(const std::string& where, const char* compression) {
  throw DamagedPart(where, std::string("does not unpack (") + compression + ")", "it is skipped");
}

// Bytes that grow as they are unpacked: a wrong size costs no memory.
class Unpacked {
 public:
  Unpacked(size_t packed, uint64_t size) : size_(size_t(size)) {
    bytes_.resize(std::min(size_, 4 * packed + kPiece));
  }
  // Where the next bytes go, and how many of them; 0: it has its size.
  char* end() { return bytes_.data() + used_; }
  size_t room() {
    if (used_ == bytes_.size()) bytes_.resize(std::min(size_, 2 * used_));
    return bytes_.size() - used_;
  }
  void add(size_t count) { used_ += count; }
  bool is_complete() const { return used_ == size_; }
  std::string take() { return std::move(bytes_); }

 private:
  static constexpr size_t kPiece = 1 << 16;
  size_t size_, used_ = 0;
  std::string bytes_;
};

void unpack_bz2(std::string_view packed, const std::string& where, Unpacked* bytes) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) fail(where, "bz2");
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> end(&stream, BZ2_bzDecompressEnd);
  stream.next_in = const_cast<char*>(packed.data());
  stream.avail_in = unsigned(packed.size());
  for (int result = BZ_OK; result != BZ_STREAM_END;) {
    const size_t room = bytes->room();
    const unsigned left = stream.avail_in;
    stream.avail_out = unsigned(room);
    stream.next_out = bytes->end();
    result = BZ2_bzDecompress(&stream);
    const size_t written = room - stream.avail_out;
    bytes->add(written);
    const bool goes_on = result == BZ_OK && (written > 0 || stream.avail_in < left);
    if (result != BZ_STREAM_END && !goes_on) fail(where, "bz2");
  }
}

using Lz4Context = std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)>;

Lz4Context lz4_context() {
  LZ4F_dctx* context = nullptr;
  LZ4F_createDecompressionContext(&context, LZ4F_VERSION);
  return {context, LZ4F_freeDecompressionContext};
}

void unpack_lz4(std::string_view packed, const std::string& where, Unpacked* bytes) {
  const Lz4Context context = lz4_context();
  for (size_t in = 0, hint = 1; hint != 0;) {
    size_t read = packed.size() - in, written = bytes->room();
    hint = LZ4F_decompress(context.get(), bytes->end(), &written, packed.data() + in, &read, nullptr);
    if (LZ4F_isError(hint) || (read == 0 && written == 0 && hint != 0)) fail(where, "lz4");
    in += read;
    bytes->add(written);
  }
}

using ZstdStream = std::unique_ptr<ZSTD_DStream, size_t (*)(ZSTD_DStream*)>;

}  // namespace

Compression compression_of(const std::string& name, const std::string& where) {
  if (name.empty() || name == "none") return Compression::kNone;
  if (name == "bz2") return Compression::kBz2;
  if (name == "lz4") return Compression::kLz4;
  if (name == "zstd") return Compression::kZstd;
  throw InputError(where, "the compression '" + printable(name) + "' is not read",
                   "compress it by lz4 or zstd, or not at all");
}

std::string unpack(Compression compression, std::string_view packed, uint64_t size,
                   const std::string& where) {
  if (size > kMaxUnpacked)
    throw DamagedPart(where, "states a size of " + std::to_string(size) + " bytes", "it is skipped");
  if (compression == Compression::kNone) return std::string(packed);
  if (compression == Compression::kZstd) {
    std::string bytes;
    unpack_zstd(packed, size_t(size) + 1, where, &bytes);
    if (bytes.size() != size) fail(where, "zstd");
    return bytes;
  }
  Unpacked bytes(packed.size(), size);
  compression == Compression::kBz2 ? unpack_bz2(packed, where, &bytes) : unpack_lz4(packed, where, &bytes);
  if (!bytes.is_complete()) fail(where, compression == Compression::kBz2 ? "bz2" : "lz4");
  return bytes.take();
}

bool is_zstd(std::string_view bytes) { return bytes.substr(0, 4) == "\x28\xB5\x2F\xFD"; }

void unpack_zstd(std::string_view packed, size_t max_bytes, const std::string& where, std::string* bytes) {
  const ZstdStream stream(ZSTD_createDStream(), ZSTD_freeDStream);
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  bytes->clear();
  for (size_t hint = 1; hint != 0 && bytes->size() < max_bytes;) {
    const size_t before = bytes->size();
    if (before > kMaxUnpacked) fail(where, "zstd");
    bytes->resize(before + std::min(max_bytes - before, ZSTD_DStreamOutSize()));
    ZSTD_outBuffer out{bytes->data() + before, bytes->size() - before, 0};
    const size_t read_before = in.pos;
    hint = ZSTD_decompressStream(stream.get(), &out, &in);
    bytes->resize(before + out.pos);
    if (ZSTD_isError(hint) || (hint != 0 && out.pos == 0 && in.pos == read_before)) fail(where, "zstd");
  }
}

bool unpack_zstd_file(const std::string& packed, const std::string& unpacked) {
  RandomFile file(packed);
  if (!is_zstd(file.read(0, 4))) throw InputError(packed, "is not a Zstandard file", "check the recording");
  const ZstdStream stream(ZSTD_createDStream(), ZSTD_freeDStream);
  OutputFile target(unpacked);
  std::string piece(ZSTD_DStreamOutSize(), '\0');
  size_t hint = 1;
  for (uint64_t at = 0; at < file.size();) {
    const std::string_view bytes = file.read(at, ZSTD_DStreamInSize());
    if (bytes.empty()) break;
    at += bytes.size();
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    for (bool full = true; in.pos < in.size || full;) {
      ZSTD_outBuffer out{piece.data(), piece.size(), 0};
      hint = ZSTD_decompressStream(stream.get(), &out, &in);
      if (ZSTD_isError(hint)) return target.close(), false;
      target.write({piece.data(), out.pos});
      full = out.pos == out.size;
    }
  }
  target.close();
  return hint == 0;
}

}  // namespace edgevo
