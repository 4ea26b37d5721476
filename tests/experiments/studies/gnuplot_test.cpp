#include "experiments/studies/gnuplot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "kernel/error.h"
#include "tests/error_message.h"
#include "tests/experiments/studies/gnuplot_fixture.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

class Gnuplot : public WithGnuplot {
 protected:
  std::string Head(const std::string& file) const {
    std::ifstream stream(folder_ / file, std::ios::binary);
    std::string head(4, '\0');
    stream.read(head.data(), 4);
    return head;
  }

  const TemporaryFolder folder_{"gnuplot's"};  // a name that a shell would stumble over
};

TEST_F(Gnuplot, DrawsBothFormatsAndKeepsWhatTheyAreMadeOf) {
  DrawPlot(folder_, "line", {"0 1\n1 2\n", "plot data with linespoints", 3, 2});
  EXPECT_EQ(Head("line.png"), "\x89PNG");
  EXPECT_EQ(Head("line.pdf"), "%PDF");
  EXPECT_TRUE(fs::exists(folder_ / "line.gp"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 4);
}

TEST_F(Gnuplot, TellsWhatGnuplotSays) {
  const auto draw = [&] { DrawPlot(folder_, "bad", {"", "plot nonsense(", 3, 2}); };
  EXPECT_THAT(
      MessageOf(ErrorKind::kResource, draw),
      testing::AllOf(testing::HasSubstr("bad.gp"), testing::HasSubstr("invalid expression")));
}

TEST(GnuplotMissing, IsSaidWithItsRemedy) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  EXPECT_THAT(MessageOf(ErrorKind::kResource, RequireGnuplot),
              testing::HasSubstr("apt-get install gnuplot-nox"));
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace curvefusion
