// Holds share/doc/decisions/rules.md to the code: each rule that the sources name (core/rule.h) has a row,
// with the files that ask it, and each row is such a rule.
#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "edgevo/core/input_file.h"

namespace edgevo::test {
namespace {

namespace fs = std::filesystem;

using FilesByRule = std::map<std::string, std::set<std::string>>;

void find_all(const std::string& text, const std::regex& pattern, const std::string& file,
              FilesByRule* found) {
  for (std::sregex_iterator m(text.begin(), text.end(), pattern), end; m != end; ++m)
    (*found)[(*m)[1]].insert(file);
}

// Asked by its name, or a line of the keyframe policy's list.
void find_rules(const std::string& text, const std::string& file, FilesByRule* found) {
  static const std::regex kAsked("[^_]rule\\(\"([^\"]+)\"\\)"), kListed("\\n    \\{\"([a-z ]+)\",\\s");
  find_all(text, kAsked, file, found);
  if (text.find("constexpr Rule kRules[]") != std::string::npos) find_all(text, kListed, file, found);
}

FilesByRule rules_of_sources() {
  FilesByRule found;
  const fs::path root = EDGEVO_SOURCE_DIR;
  for (const auto& entry : fs::recursive_directory_iterator(root / "modules")) {
    const fs::path& path = entry.path();
    if ((path.extension() == ".cpp" || path.extension() == ".h") && path.filename() != "rule.h")
      find_rules(read_file(path.string(), ""), fs::relative(path, root).string(), &found);
  }
  return found;
}

// Rows of the shape: | name | `modules/file.cpp`, `modules/other.h` | ...
FilesByRule rules_of_page(const std::string& page) {
  static const std::regex kRow("\\n\\| ([a-z0-9 -]+) \\| (`modules/[^|]+) \\|(?=[^\\n]*)"),
      kFile("`([^`]+)`");
  FilesByRule found;
  for (std::sregex_iterator row(page.begin(), page.end(), kRow), end; row != end; ++row) {
    const std::string files = (*row)[2];
    for (std::sregex_iterator file(files.begin(), files.end(), kFile), none; file != none; ++file)
      found[(*row)[1]].insert((*file)[1]);
  }
  return found;
}

TEST(RulesPage, NamesAreFound) {
  FilesByRule found;
  find_rules("a && rule(\"old map\") || rule(\"b\")", "x.cpp", &found);
  find_rules("constexpr Rule kRules[] = {\n    {\"long since\",\n     []", "y.cpp", &found);
  EXPECT_EQ(found, (FilesByRule{{"old map", {"x.cpp"}}, {"b", {"x.cpp"}}, {"long since", {"y.cpp"}}}));
  EXPECT_EQ(rules_of_page(
                "\n| a b | `modules/a.cpp`, `modules/b.h` | c |\n| rule | file |\n| d | `modules/d.h` | e |"),
            (FilesByRule{{"a b", {"modules/a.cpp", "modules/b.h"}}, {"d", {"modules/d.h"}}}));
}

TEST(RulesPage, HasEachRuleOfTheCodeAndNoOther) {
  const fs::path page = fs::path(EDGEVO_SOURCE_DIR) / "share/doc/decisions/rules.md";
  const FilesByRule in_code = rules_of_sources();
  EXPECT_GE(in_code.size(), 10u);
  EXPECT_EQ(rules_of_page(read_file(page.string(), "")), in_code);
}

}  // namespace
}  // namespace edgevo::test
