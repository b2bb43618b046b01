#pragma once
#include <functional>

#include "edgevo/results/run_folder.h"
#include "exporters/exporter.h"

namespace edgevo {

/// Writes those files of the run whose kind is asked for, as far as they apply; failures are noted in
/// `folder`.
void export_files(const std::function<bool(FileKind)>& requested, ExportContext* context, RunFolder* folder);

}  // namespace edgevo
