#include "kernel/free_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernel/error.h"
#include "tests/error_message.h"

namespace curvefusion {
namespace {

TEST(FreeSpace, IsComparedWithTheNeedAlsoOfWhatIsNotThereYet) {
  const std::filesystem::path place = std::filesystem::temp_directory_path() / "no" / "folder";
  EXPECT_NO_THROW(RequireFreeSpace(place, 0));
  const auto require = [&] { RequireFreeSpace(place, std::uintmax_t{1} << 62); };
  EXPECT_THAT(MessageOf(ErrorKind::kResource, require),
              testing::MatchesRegex(".*/no/folder: up to 4.61e.09 GB may be needed there and "
                                    ".* [GM]B are free.*"));
}

}  // namespace
}  // namespace curvefusion
