#pragma once
// Some frames of another source, as --frames and --every choose them.
#include <memory>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// Frames first .. last-1 of `inner`, each every-th, with their own indices; the others are passed over
/// without decoding. Throws InputError for a stretch that lies outside the source, or an `every` below 1.
std::unique_ptr<ImageSource> subsample(std::unique_ptr<ImageSource> inner, const SourceOptions& options);

}  // namespace edgevo
