#include "apps/page_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace curvefusion {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(PageParts, DataGoIntoTheirPlaceAsTheyAre) {
  const std::string page = AssemblePage("report.html", R"({"a":"{{style.css}}"})");
  EXPECT_THAT(page, HasSubstr(R"({"a":"{{style.css}}"}</script>)"));
}

TEST(PageParts, PartsAreWhole) {
  for (const PagePart& part : PageParts()) {
    if (part.name.ends_with(".html")) continue;
    if (part.text.find("{{") != std::string_view::npos) continue;
    EXPECT_EQ(AssemblePage(part.name, ""), part.text) << part.name;
  }
}

}  // namespace
}  // namespace curvefusion
