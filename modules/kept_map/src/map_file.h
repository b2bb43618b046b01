// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A map file that appears at once, whenever the program is killed: it is made under another name.
#include <string>

#include "database.h"
#include "edgevo/core/error.h"

namespace edgevo {

/// Name of the file while it is made.
std::string name_while_made(const std::string& path);
/// Removes a map file with its logs.
void remove_map_files(const std::string& path);
/// Gives the file that was made its name, in place of what is there. Throws InputError.
void take_its_name(const std::string& path);

/// Does it; a failure of the database becomes one of the file, an InputError with `remedy`.
template <class Work>
void attempt_writing(const std::string& path, const std::string& remedy, const Work& work) {
  try {
    work();
  } catch (const DatabaseError& e) {
    throw InputError(path, std::string("cannot be written: ") + e.what(), remedy);
  }
}

}  // namespace edgevo
