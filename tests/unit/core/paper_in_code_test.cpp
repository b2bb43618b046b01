// SPDX-License-Identifier: BSD-3-Clause
// Checks share/doc/paper_in_code.md against the code, both ways: each tag `Eq. (label)` of the modules has an
// entry that names the file, and each function named on the page is in the file named for it.
#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "edgevo/core/input_file.h"

namespace edgevo::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

namespace fs = std::filesystem;

// Joins the lines of a comment.
std::string without_line_breaks(const std::string& text) {
  return std::regex_replace(text, std::regex("\n\\s*///?\\s*"), " ");
}

// Labels of `Eq. (label)` and `Eqs. (label) and (label)`.
std::set<std::string> equation_tags(const std::string& text) {
  static const std::regex kTag("Eqs?\\.\\s*\\(([a-z]+)\\)(?: and \\(([a-z]+)\\))?");
  const std::string joined = without_line_breaks(text);
  std::set<std::string> tags;
  for (std::sregex_iterator m(joined.begin(), joined.end(), kTag), end; m != end; ++m)
    for (const size_t group : {1, 2})
      if ((*m)[group].matched) tags.insert((*m)[group]);
  return tags;
}

struct NamedFunction {
  std::string name, file;
};

// The text under a heading `### Eq. (label)`.
struct Entry {
  std::vector<NamedFunction> functions;
  std::set<std::string> files;
};

std::map<std::string, Entry> entries_of(const std::string& page) {
  static const std::regex kLine("^(?:### Eq\\. \\(([a-z]+)\\)|#+ .*|- `([A-Za-z_:]+)` in `([^`]+)`: .*)$");
  std::map<std::string, Entry> entries;
  Entry none, *entry = &none;
  std::istringstream lines(page);
  std::smatch m;
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_match(line, m, kLine)) continue;
    if (m[1].matched) {
      entry = &entries[m[1]];
    } else if (m[2].matched) {
      entry->functions.push_back({m[2], m[3]});
      entry->files.insert(m[3]);
    } else {
      entry = &none;
    }
  }
  return entries;
}

// Files of the repository that the page names in backquotes.
std::set<std::string> named_files(const std::string& page) {
  static const std::regex kFile("`((?:modules|params|app|share|tests)/[A-Za-z_0-9/.]+)`");
  std::set<std::string> files;
  for (std::sregex_iterator m(page.begin(), page.end(), kFile), end; m != end; ++m) files.insert((*m)[1]);
  return files;
}

bool has_word(const std::string& text, const std::string& word) {
  return std::regex_search(text, std::regex("\\b" + word + "\\b"));
}

TEST(PaperInCode, TagsAreFound) {
  EXPECT_THAT(equation_tags("// Eq. (edgeerror), Eqs. (a) and (b)"),
              UnorderedElementsAre("a", "b", "edgeerror"));
  EXPECT_THAT(equation_tags("/// the paper's Eq.\n  /// (aml) as printed"), ElementsAre("aml"));
  EXPECT_THAT(equation_tags("eq (a), Eq. 3, Eq. (Nr 1)"), IsEmpty());
}

TEST(PaperInCode, EntriesAreRead) {
  const auto entries = entries_of(
      "### Eq. (a)\n- `f` in `modules/x/src/f.cpp`: makes it\n## Figures\n- `g` in `modules/g.cpp`: no\n");
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_THAT(entries.at("a").files, ElementsAre("modules/x/src/f.cpp"));
  EXPECT_EQ(entries.at("a").functions.at(0).name, "f");
}

class PaperInCodePage : public ::testing::Test {
 protected:
  const fs::path root = EDGEVO_SOURCE_DIR;
  const std::string page = read_file((root / "share/doc/paper_in_code.md").string(), "");
  const std::map<std::string, Entry> entries = entries_of(page);
};

TEST_F(PaperInCodePage, NamesEachFileThatCarriesATag) {
  int tags = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root / "modules")) {
    if (!entry.is_regular_file()) continue;
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    const std::string file = fs::relative(entry.path(), root).generic_string();
    for (const std::string& tag : equation_tags(read_file(entry.path().string(), ""))) {
      ++tags;
      const auto there = entries.find(tag);
      ASSERT_NE(there, entries.end())
          << file << ": Eq. (" << tag << ") has no heading in share/doc/paper_in_code.md";
      EXPECT_THAT(there->second.files, Contains(file)) << "not named under Eq. (" << tag << ")";
    }
  }
  EXPECT_GT(tags, 20);
}

TEST_F(PaperInCodePage, NamesFunctionsInTheirFiles) {
  size_t functions = 0;
  for (const auto& [tag, entry] : entries)
    for (const NamedFunction& f : entry.functions) {
      ++functions;
      ASSERT_TRUE(fs::exists(root / f.file)) << f.file << ", under Eq. (" << tag << ")";
      EXPECT_TRUE(has_word(read_file((root / f.file).string(), ""), f.name))
          << f.name << " is not in " << f.file;
    }
  EXPECT_GT(functions, 40u);
}

TEST_F(PaperInCodePage, NamesFilesThatExist) {
  const std::set<std::string> files = named_files(page);
  EXPECT_GT(files.size(), 25u);
  for (const std::string& file : files) EXPECT_TRUE(fs::exists(root / file)) << file;
}

TEST_F(PaperInCodePage, HasEveryEquationOfThePaper) {
  for (const char* label :
       {"pointproj", "edgeerror", "reprojectionerror", "photometricerror", "searchradius", "intersection",
        "radiusequation", "rediusuncertainty", "uncertaintyseperation", "searchregion", "poseuncertainty",
        "firstcomponent", "secondcomponent", "depth", "depthuncertainty", "depthlength", "amlconfidence",
        "depthconfidence", "distancecheck"}) {
    ASSERT_TRUE(entries.count(label)) << label;
    EXPECT_FALSE(entries.at(label).functions.empty()) << label;
  }
}

}  // namespace
}  // namespace edgevo::test
