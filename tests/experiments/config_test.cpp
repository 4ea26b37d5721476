#include "experiments/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "kernel/error.h"
#include "tests/error_message.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

// The message of the Error that reading these sources throws.
std::string MessageOfConfig(const ConfigSources& sources) {
  return MessageOf(ErrorKind::kUsage, [&] { ReadConfig(sources); });
}

std::string MessageOfSet(const std::string& assignment) {
  return MessageOfConfig({.profile = {}, .file = {}, .assignments = {assignment}});
}

class ConfigFile : public testing::Test {
 protected:
  ConfigSources Write(const std::string& text) {
    std::ofstream(folder_ / "a.toml") << text;
    return {.profile = {}, .file = folder_ / "a.toml", .assignments = {}};
  }

  const TemporaryFolder folder_{"config"};
};

TEST_F(ConfigFile, WhatIsWrittenIsReadBack) {
  for (const Profile profile : {Profile::kPaper, Profile::kBest}) {
    Config config = ProfileConfig(profile);
    // 0.1 / 13 needs all its digits.
    std::visit([](auto& options) { options.volume.voxel_size = 0.1 / 13; }, config.pipeline);
    const std::string text = ConfigToml(config);
    EXPECT_EQ(ConfigToml(ReadConfig(Write(text))), text);
    EXPECT_EQ(VolumeOptions(ReadConfig(Write(text)).pipeline).voxel_size, 0.1 / 13);
  }
}

TEST_F(ConfigFile, TheProfileComesFromTheCommandLineThenTheFileThenIsBest) {
  EXPECT_EQ(ReadConfig({}).profile, Profile::kBest);
  ConfigSources sources = Write("profile = \"paper\"\n");
  EXPECT_EQ(ReadConfig(sources).profile, Profile::kPaper);
  sources.profile = Profile::kBest;
  EXPECT_EQ(ReadConfig(sources).profile, Profile::kBest);
}

TEST_F(ConfigFile, AnAssignmentOverridesTheFile) {
  ConfigSources sources = Write("[volume]\nvoxel_size = 0.006\ntruncation_voxels = 5\n");
  sources.assignments = {"volume.voxel_size=0.007"};
  const Config config = ReadConfig(sources);
  EXPECT_EQ(VolumeOptions(config.pipeline).voxel_size, 0.007);
  EXPECT_EQ(VolumeOptions(config.pipeline).truncation_voxels, 5);
}

TEST_F(ConfigFile, ErrorsNameFileAndLine) {
  EXPECT_THAT(MessageOfConfig(Write("\n[volume]\n\nvoxel_siz = 0.006\n")),
              AllOf(HasSubstr("a.toml:4:"), HasSubstr("volume.voxel_siz"),
                    HasSubstr("did you mean volume.voxel_size?")));
  EXPECT_THAT(MessageOfConfig(Write("[volume]\nvoxel_size = = 1\n")),
              HasSubstr("a.toml:2: not valid"));
  EXPECT_THAT(MessageOfConfig(Write("profile = 3\n")), HasSubstr("\"paper\" or \"best\""));
}

TEST_F(ConfigFile, AFileThatCannotBeReadIsBadInput) {
  for (const fs::path& file : {folder_ / "none.toml", folder_.path(), fs::path("/dev/zero")}) {
    const auto read = [&] { ReadConfig({.profile = {}, .file = file, .assignments = {}}); };
    EXPECT_THAT(MessageOf(ErrorKind::kBadInput, read), HasSubstr(file.string()));
  }
}

TEST(Config, AnUnknownNameIsAnswereWithTheNearest) {
  EXPECT_THAT(MessageOfSet("volum.voxel_size=0.01"), HasSubstr("did you mean volume?"));
  EXPECT_THAT(MessageOfSet("volume.truncation_voxel=4"),
              HasSubstr("did you mean volume.truncation_voxels?"));
}

TEST(Config, AValueOutOfRangeIsAnsweredWithTheRangeAndItsUnit) {
  EXPECT_THAT(MessageOfSet("volume.voxel_size=7"),
              AllOf(HasSubstr("volume.voxel_size = 7"), HasSubstr(" to "), HasSubstr(" m")));
  EXPECT_THAT(MessageOfSet("volume.voxel_size=nan"), HasSubstr("range"));
  EXPECT_THAT(MessageOfSet("volume.truncation_voxels=9223372036854775807"), HasSubstr("range"));
}

TEST(Config, ValuesThatDoNotFitEachOtherAreRefused) {
  EXPECT_THAT(MessageOfSet("volume.voxel_size=0.004"),
              AllOf(HasSubstr("segmentation.solid_depth = 0.03 m"),
                    HasSubstr("set volume.truncation_voxels to 8 or more")));
  const auto read = [](Profile profile, std::vector<std::string> assignments) {
    return ReadConfig({.profile = profile, .file = {}, .assignments = std::move(assignments)});
  };
  EXPECT_NO_THROW(read(Profile::kBest, {"volume.voxel_size=0.004", "volume.truncation_voxels=8"}));
  EXPECT_NO_THROW(read(Profile::kBest, {"volume.voxel_size=0.004", "segmentation.solid_depth=0"}));
  EXPECT_NO_THROW(read(Profile::kPaper, {"volume.voxel_size=0.004"}));
}

TEST(Config, AnOptionWithoutItsSectionIsAnsweredWithIt) {
  EXPECT_THAT(MessageOfSet("min_frames=3"), HasSubstr("did you mean bundle.min_frames?"));
  EXPECT_THAT(MessageOfSet("voxel_size=4mm"), HasSubstr("volume.voxel_size"));
  EXPECT_THAT(MessageOfSet("volume=4"), HasSubstr("volume is a section; write volume.key=value"));
}

TEST(Config, AValueOfAnotherTypeIsRefused) {
  EXPECT_THAT(MessageOfSet("volume.truncation_voxels=4.5"), HasSubstr("4.5 is not a whole number"));
  EXPECT_THAT(MessageOfSet("volume.voxel_size=abc"),
              HasSubstr("volume.voxel_size: abc is not a number; the unit is metres"));
  EXPECT_THAT(MessageOfSet("volume.voxel_size="), HasSubstr("there is no value; write a number"));
  EXPECT_THAT(MessageOfSet("volume.voxel_size=\"\""), HasSubstr("there is no value"));
  EXPECT_THAT(MessageOfSet("volume.voxel_size=[1, 2]"), HasSubstr("a list is not a number"));
  EXPECT_THAT(MessageOfSet("volume.voxel_size={x = 1}"), HasSubstr("a table is not a number"));
  EXPECT_THAT(MessageOfSet("volume.voxel_size=true"), HasSubstr("true is not a number"));
  EXPECT_THAT(MessageOfSet("colour_adjustment.enabled=maybe"),
              HasSubstr("maybe is not true or false"));
  EXPECT_THAT(MessageOfSet("=3"), HasSubstr("section.key=value"));
  EXPECT_THAT(MessageOfSet("volume.voxel_size"), HasSubstr("section.key=value"));
  EXPECT_THAT(MessageOfSet("profile=\"paper\""), HasSubstr("--profile"));
}

TEST(Config, AWordOutOfSeveralIsReadAndWritten) {
  const Config config = ReadConfig({Profile::kBest, {}, {"depth.use=background"}});
  EXPECT_EQ(std::get<BestOptions>(config.pipeline).depth.use, DepthRole::kBackground);
  EXPECT_THAT(ConfigToml(config), HasSubstr("use = \"background\""));
  ASSERT_EQ(ChangedOptions(config).size(), 1u);
  EXPECT_EQ(ChangedOptions(config)[0].value, "\"background\"");
  EXPECT_THAT(MessageOfSet("depth.use=wire"),
              HasSubstr("wire is not one of auto, wires, background, none"));
  EXPECT_THAT(MessageOfSet("depth.use=2"), HasSubstr("2 is not one of auto"));
}

TEST(Config, AValueWithAUnitIsAnsweredWithTheValueInItsOwn) {
  for (const char* value : {"4mm", "4 mm", "\"4 mm\"", ".4cm", "0.004m"}) {
    EXPECT_THAT(MessageOfSet(std::string("volume.voxel_size=") + value),
                HasSubstr("is not a number; the unit is metres: 0.004"));
  }
  EXPECT_THAT(MessageOfSet("ghosts.verified_share=20%"), HasSubstr("write 0.2"));
}

TEST(Config, AnUnknownProfileIsAnsweredWithTheNearest) {
  EXPECT_THROW(ProfileNamed("papper"), Error);
  EXPECT_EQ(ProfileNamed("paper"), Profile::kPaper);
}

// Records whether a default lies outside of its range.
class RangeCheck : public OptionVisitor {
 public:
  void BeginSection(const char* name) override {
    section_ = name;
    EXPECT_TRUE(names_.insert(section_).second) << section_ << " is there twice";
  }
  void Visit(const OptionInfo& info, double& value) override { Check(info, value); }
  void Visit(const OptionInfo& info, int& value) override { Check(info, value); }
  void Visit(const OptionInfo& info, bool&) override { Check(info, info.min); }

 private:
  void Check(const OptionInfo& info, double value) {
    const std::string name = section_ + "." + info.name;
    EXPECT_TRUE(names_.insert(name).second) << name << " is there twice";
    EXPECT_GE(value, info.min) << name;
    EXPECT_LE(value, info.max) << name;
    EXPECT_STRNE(info.description, "") << name;
  }

  std::string section_;
  std::set<std::string> names_;
};

TEST(Config, NamesAreUniqueAndEveryDefaultLiesInItsRange) {
  for (const Profile profile : {Profile::kPaper, Profile::kBest}) {
    Config config = ProfileConfig(profile);
    RangeCheck check;
    VisitOptions(config, check);
  }
}

}  // namespace
}  // namespace curvefusion
