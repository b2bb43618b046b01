// SPDX-License-Identifier: BSD-3-Clause
#include "export_files.h"

namespace edgevo {

void export_files(const std::function<bool(FileKind)>& requested, ExportContext* context, RunFolder* folder) {
  for (const Exporter& exporter : exporters()) {
    if (!exporter.write || !requested(exporter.kind) || (exporter.applies && !exporter.applies(*context)))
      continue;
    context->not_written = folder->not_written();
    folder->attempt(exporter.file, [&](const std::string& path) { exporter.write(context, path); });
  }
}

}  // namespace edgevo
