// SPDX-License-Identifier: BSD-3-Clause
#include "texture_kinds.h"

#include "edgevo/core/error.h"

namespace edgevo {

const std::vector<TextureKind>& texture_kinds() {
  static const std::vector<TextureKind> kinds = [] {
    std::vector<TextureKind> all;
    for (const auto& family : {wall_textures(), front_textures(), ground_textures(), nature_textures(),
                               object_textures(), body_textures(), plain_textures()})
      all.insert(all.end(), family.begin(), family.end());
    return all;
  }();
  return kinds;
}

const TextureKind& texture_kind(const std::string& name, const std::string& where) {
  std::vector<std::string> names;
  for (const TextureKind& kind : texture_kinds()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  throw InputError(where, "there is no texture '" + name + "'",
                   "did you mean '" + nearest_name(name, names) + "'?");
}

}  // namespace edgevo
