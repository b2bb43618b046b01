// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A subset of another source's frames, as --frames and --every select them.
#include <memory>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// Every `every`-th of the frames first .. last-1 of `inner`, with their own indices; the others are skipped
/// without decoding. Throws InputError for a range outside the source, or an `every` below 1.
std::unique_ptr<ImageSource> subsample(std::unique_ptr<ImageSource> inner, const SourceOptions& options);

}  // namespace edgevo
