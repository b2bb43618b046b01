// SPDX-License-Identifier: BSD-3-Clause
// Checks share/doc/extending.md and the decisions against the code: the files that they name exist and
// contain the names given for them.
#include <gmock/gmock.h>

#include <filesystem>
#include <regex>

#include "edgevo/core/input_file.h"

namespace edgevo::test {
namespace {

namespace fs = std::filesystem;

const std::string kFile = "((?:modules|params|app|share|tests|datasets)/[A-Za-z_0-9/]+\\.[a-z]+)";

struct Named {
  std::string name, file;
};

// Texts of the shape: `name` in `path/of/a/file.cpp`, over line breaks.
std::vector<Named> named_in_files(const std::string& page) {
  static const std::regex kNamed("`([A-Za-z_:]+)`\\s+in\\s+`" + kFile + "`");
  std::vector<Named> all;
  for (std::sregex_iterator m(page.begin(), page.end(), kNamed), end; m != end; ++m)
    all.push_back({(*m)[1], (*m)[2]});
  return all;
}

// All files in backquotes, except those to be created, whose names contain NAME.
std::vector<std::string> files_of(const std::string& page) {
  static const std::regex kQuoted("`" + kFile + "`");
  std::vector<std::string> files;
  for (std::sregex_iterator m(page.begin(), page.end(), kQuoted), end; m != end; ++m)
    if ((*m)[1].str().find("NAME") == std::string::npos) files.push_back((*m)[1]);
  return files;
}

// The last part of a qualified name.
std::string short_name(const std::string& name) {
  const size_t colon = name.rfind(':');
  return colon == std::string::npos ? name : name.substr(colon + 1);
}

const fs::path kRoot = EDGEVO_SOURCE_DIR;

void expect_true_of_the_code(const fs::path& page_path) {
  const std::string page = read_file(page_path.string(), "");
  for (const std::string& file : files_of(page))
    EXPECT_TRUE(fs::exists(kRoot / file)) << page_path << " names " << file;
  for (const Named& n : named_in_files(page)) {
    if (!fs::exists(kRoot / n.file)) continue;  // reported above
    const std::string text = read_file((kRoot / n.file).string(), "");
    EXPECT_TRUE(std::regex_search(text, std::regex("\\b" + short_name(n.name) + "\\b")))
        << page_path << ": " << n.name << " is not in " << n.file;
  }
}

TEST(Extending, NamesAreFound) {
  const auto named = named_in_files("`a::b` in\n `modules/x/src/b.cpp`, `c` of `d.h`");
  ASSERT_EQ(named.size(), 1u);
  EXPECT_EQ(short_name(named[0].name), "b");
  EXPECT_EQ(named[0].file, "modules/x/src/b.cpp");
  EXPECT_THAT(files_of("`app/cmd_NAME.cpp` and `app/main.cpp`"), ::testing::ElementsAre("app/main.cpp"));
}

TEST(Extending, PageMatchesTheCode) {
  const fs::path page = kRoot / "share/doc/extending.md";
  EXPECT_GT(named_in_files(read_file(page.string(), "")).size(), 30u);
  expect_true_of_the_code(page);
}

TEST(Extending, OtherPagesMatchTheCode) {
  int pages = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "share/doc"))
    if (entry.path().extension() == ".md") expect_true_of_the_code(entry.path()), ++pages;
  EXPECT_GT(pages, 20);
}

}  // namespace
}  // namespace edgevo::test
