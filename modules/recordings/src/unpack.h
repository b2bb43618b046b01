// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Decompression of parts of recordings.
#include <cstdint>
#include <string>
#include <string_view>

namespace edgevo {

/// Compressions of recordings.
enum class Compression { kNone, kBz2, kLz4, kZstd };

/// Largest part of a recording that is unpacked in memory, bytes.
constexpr uint64_t kMaxUnpacked = uint64_t(1) << 30;

/// The compression of a name ("", "none", "bz2", "lz4", "zstd"). Throws InputError that names it, opened by
/// `where`.
Compression compression_of(const std::string& name, const std::string& where);

/// `packed` (a bzip2 stream, an LZ4 frame or a Zstandard frame) as bytes, which must be `size`. Throws
/// DamagedPart opened by `where`.
std::string unpack(Compression compression, std::string_view packed, uint64_t size, const std::string& where);

/// Whether the bytes begin a Zstandard frame.
bool is_zstd(std::string_view bytes);

/// The first `max_bytes` of what a Zstandard frame holds. Throws DamagedPart opened by `where`.
void unpack_zstd(std::string_view packed, size_t max_bytes, const std::string& where, std::string* bytes);

/// Unpacks a Zstandard file into a new file, piece by piece; a file that was cut off as far as it goes.
/// Returns whether it was whole. Throws InputError: disk full, not such a file.
bool unpack_zstd_file(const std::string& packed, const std::string& unpacked);

}  // namespace edgevo
