// SPDX-License-Identifier: BSD-3-Clause
// The files in params/ are readable, and default.yaml lists the basic parameters with their defaults.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "edgevo/core/block_yaml.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/results/run_params.h"

namespace edgevo {
namespace {

const std::string kFolder = std::string(EDGEVO_SOURCE_DIR) + "/params/";

std::vector<std::string> files() {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    if (entry.path().extension() == ".yaml") found.push_back(entry.path().string());
  return found;
}

std::string written(RunParams params) {
  return write_params([&](ParamVisitor& v) { params.visit(v); });
}

TEST(ParamsFiles, EachIsReadable) {
  for (const std::string& file : files()) {
    RunParams params;
    EXPECT_NO_THROW(read_params_file(file, [&](ParamVisitor& v) { params.visit(v); })) << file;
  }
  EXPECT_EQ(files().size(), 2u);
}

TEST(ParamsFiles, APresetSetsNoDefault) {
  for (const std::string& file : files()) {
    if (file == kFolder + "default.yaml") continue;
    for (const YamlEntry& entry : parse_block_yaml(read_file(file, ""), file)) {
      if (!entry.has_value) continue;
      RunParams params;
      set_param(entry.key + "=" + entry.value, [&](ParamVisitor& v) { params.visit(v); });
      EXPECT_NE(written(params), written(RunParams())) << file << ": " << entry.key << " is the default";
    }
  }
}

TEST(ParamsFiles, EachSettingOfTheAblationChangesAParameter) {
  const std::string file = std::string(EDGEVO_SOURCE_DIR) + "/share/bench/ablation.yaml";
  int settings = 0;
  for (const YamlEntry& entry : parse_block_yaml(read_file(file, ""), file)) {
    if (entry.key.rfind("set.", 0) != 0) continue;
    RunParams params;
    std::istringstream assignments(entry.value);
    for (std::string assignment; assignments >> assignment;)
      set_param(assignment, [&](ParamVisitor& v) { params.visit(v); });
    EXPECT_NE(written(params), written(RunParams())) << entry.key;
    ++settings;
  }
  EXPECT_GT(settings, 12);
}

TEST(ParamsFiles, TheReadmeNamesEach) {
  const std::string readme = read_file(kFolder + "README.md", "");
  for (const std::string& file : files()) {
    const std::string name = std::filesystem::path(file).filename().string();
    EXPECT_NE(readme.find("`" + name + "`"), std::string::npos) << name;
  }
}

// The lines below the first comment are those of write_basic_params(); if this fails, copy them from the
// message.
TEST(ParamsFiles, DefaultYamlListsTheBasicParameters) {
  std::istringstream file(read_file(kFolder + "default.yaml", ""));
  std::string line, body;
  while (std::getline(file, line))
    if (line.rfind("#", 0) != 0) body += line + "\n";
  RunParams params;
  EXPECT_EQ(body, write_basic_params([&](ParamVisitor& v) { params.visit(v); }));
}

TEST(ParamsFiles, FewAreBasic) {
  RunParams params;
  int basic = 0;
  for (const ParamDescription& p : describe_params([&](ParamVisitor& v) { params.visit(v); }))
    basic += p.level == ParamLevel::kBasic;
  EXPECT_LE(basic, 20);
}

TEST(ParamsFiles, AnUnknownKeySuggestsTheNearest) {
  RunParams params;
  try {
    read_params("mapping:\n  window:\n    keyframe: 9\n", "test.yaml",
                [&](ParamVisitor& v) { params.visit(v); });
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("mapping.window.keyframes"), std::string::npos) << e.what();
  }
}

TEST(ParamsFiles, TheExampleInTheHintIsAccepted) {
  const auto set = [](const std::string& assignment) {
    RunParams params;
    set_param(assignment, [&](ParamVisitor& v) { params.visit(v); });
  };
  try {
    set("mapping");
    FAIL();
  } catch (const InputError& e) {
    const std::string text = e.what(), before = "for example --set ";
    const size_t at = text.find(before);
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_NO_THROW(set(text.substr(at + before.size()))) << text;
  }
}

}  // namespace
}  // namespace edgevo
