// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The filters of PNG: each byte of a row is stored as its difference to what its neighbours predict.
#include <cstddef>
#include <cstdint>

namespace edgevo {

/// Adds to the bytes of an image what the filters of its rows predict. `rows`: for each row the number of its
/// filter and `row_bytes` bytes; `channels`: bytes of a pixel, 1 or 3; `pixels`: rows of `stride` bytes.
/// Returns false if a row has an unknown filter; `pixels` is then incomplete.
bool unfilter_rows(const uint8_t* rows, int row_count, int row_bytes, int channels, uint8_t* pixels,
                   std::ptrdiff_t stride);

}  // namespace edgevo
