// The files in params/ are what users start from: each must be readable, and default.yaml must list the
// defaults, all of them.
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
  EXPECT_EQ(files().size(), 6u);
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

TEST(ParamsFiles, TheReadmeTellsOfEach) {
  const std::string readme = read_file(kFolder + "README.md", "");
  for (const std::string& file : files()) {
    const std::string name = std::filesystem::path(file).filename().string();
    EXPECT_NE(readme.find("`" + name + "`"), std::string::npos) << name;
  }
}

TEST(ParamsFiles, DefaultYamlListsEveryParameterWithItsDefault) {
  // Start from other values everywhere, so that a key missing in the file would show.
  class Disturb : public ParamVisitor {
   public:
    void number(const char*, double& value, double min, double max, const char*) override {
      value = value == min ? max : min;
    }
    void integer(const char*, int& value, int min, int max, const char*) override {
      value = value == min ? max : min;
    }
    void boolean(const char*, bool& value, const char*) override { value = !value; }
    void text(const char*, std::string& value, const std::vector<std::string>& choices,
              const char*) override {
      value = choices.empty() ? value + "x" : choices.front() == value ? choices.back() : choices.front();
    }
    void begin_group(const char*) override {}
    void end_group() override {}
  };
  RunParams params;
  Disturb disturb;
  params.visit(disturb);
  ASSERT_NE(written(params), written(RunParams()));
  read_params_file(kFolder + "default.yaml", [&](ParamVisitor& v) { params.visit(v); });
  EXPECT_EQ(written(params), written(RunParams()));
}

TEST(ParamsFiles, UnknownKeyOffersTheNearest) {
  RunParams params;
  try {
    read_params("mapping:\n  window:\n    keyframe: 9\n", "test.yaml",
                [&](ParamVisitor& v) { params.visit(v); });
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("mapping.window.keyframes"), std::string::npos) << e.what();
  }
}

TEST(ParamsFiles, TheHintOfSetIsAccepted) {
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
