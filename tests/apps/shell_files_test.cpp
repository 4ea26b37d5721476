#include "apps/shell_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <regex>
#include <string>

#include "apps/command_line.h"
#include "tests/apps/command_line_fixture.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;

class ShellFiles : public CommandLine {
 protected:
  ShellFiles() { AddCommandLine(app_, exit_code_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  // What bash completes of a line, the last word of which is being typed.
  std::string Completed(const std::string& words) const {
    Write("curvefusion.bash", BashCompletion(app_));
    return RunShell("bash -c '. ./curvefusion.bash; COMP_WORDS=(" + words +
                    "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _curvefusion; "
                    "echo \"${COMPREPLY[*]}\"' >output.txt 2>&1")
        .output;
  }

  // Whether a shell that is installed takes its file for a program; true where it is not.
  bool IsTakenBy(const std::string& shell, const std::string& flag, const std::string& text) const {
    Write("completion", text);
    return RunShell("! command -v " + shell + " >/dev/null || " + shell + " " + flag +
                    " completion >output.txt 2>&1")
               .exit_code == 0;
  }

  CLI::App app_;
  int exit_code_ = 0;
};

TEST_F(ShellFiles, ThePageHasEveryCommandAndOption) {
  const std::string page = ManualPage(app_);
  int options = 0;
  for (const CLI::App* command : app_.get_subcommands({})) {
    EXPECT_THAT(page, HasSubstr(".SS curvefusion " + command->get_name() + "\n"));
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& plain : option->get_lnames()) {
        const std::string name = std::regex_replace(plain, std::regex("-"), "\\-");
        EXPECT_THAT(page, HasSubstr("\\fB\\-\\-" + name + "\\fR"));
        ++options;
      }
    }
  }
  EXPECT_GT(options, 80);  // they are looked at
}

TEST_F(ShellFiles, NoTextIsTakenForACommandOfRoff) {
  CLI::App app;
  app.add_subcommand("try", ".SH in a \\fBdescription\\fR")->footer("'quoted\n.nf");
  const std::string page = ManualPage(app);
  EXPECT_THAT(page, HasSubstr("\\&.SH in a \\efBdescription\\efR"));
  EXPECT_THAT(page, HasSubstr("\\&'quoted\n\\&.nf"));
}

TEST_F(ShellFiles, BashCompletesCommandsOptionsAndValues) {
  EXPECT_EQ(Completed("curvefusion rec"), "reconstruct\n");
  EXPECT_EQ(Completed("curvefusion help con"), "contract config\n");
  EXPECT_EQ(Completed("curvefusion mesh a.json --radius-f"), "--radius-from\n");
  EXPECT_EQ(Completed("curvefusion mesh --radius-from v"), "vertex\n");
  EXPECT_EQ(Completed("curvefusion mesh -o \"\""), "\n");  // files are left to bash
  EXPECT_EQ(Completed("curvefusion mesh a"), "\n");
}

TEST_F(ShellFiles, OtherShellsTakeTheirFiles) {
  EXPECT_TRUE(IsTakenBy("zsh", "-n", ZshCompletion(app_)));
  EXPECT_TRUE(IsTakenBy("fish", "--no-execute", FishCompletion(app_)));
  EXPECT_FALSE(IsTakenBy("bash", "-n", "case"));  // a defect would be seen
  EXPECT_THAT(ZshCompletion(app_), HasSubstr("one global median]:TEXT:(global edge vertex)'"));
  EXPECT_THAT(FishCompletion(app_), HasSubstr("mesh' -l radius-from -x -a 'global edge vertex'"));
}

}  // namespace
}  // namespace curvefusion
