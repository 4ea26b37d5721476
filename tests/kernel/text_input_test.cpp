#include "kernel/text_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "kernel/error.h"
#include "kernel/json_input.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;

// The message of the Error(kBadInput) that `call` throws.
template <class Call>
std::string Rejection(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    return error.what();
  }
  return "accepted";
}

TEST(ReadFile, GivesEveryByteUpToTheLimit) {
  const std::filesystem::path path = TemporaryPath("read_file");
  const std::string content = std::string("a\r\n\0b", 5) + std::string(200000, 'c');
  std::ofstream(path, std::ios::binary) << content;
  EXPECT_EQ(ReadFile(path), content);
  EXPECT_EQ(ReadFile(path, content.size()), content);
  EXPECT_THAT(Rejection([&] { ReadFile(path, content.size() - 1); }), HasSubstr("is larger than"));
  std::filesystem::remove(path);
  EXPECT_THAT(Rejection([&] { ReadFile(path); }), HasSubstr("cannot be read"));
  EXPECT_THAT(Rejection([&] { ReadFile(path.parent_path()); }), HasSubstr("cannot be read"));
}

TEST(ReadFile, EndsWithAnEndlessFile) {
  EXPECT_THAT(Rejection([] { ReadFile("/dev/zero", 1 << 20); }), HasSubstr("the 1 MiB"));
}

TEST(LineScanner, CountsLinesOfBothKinds) {
  LineScanner lines("a\r\n\nb");
  std::string_view line;
  ASSERT_TRUE(lines.Next(line));
  EXPECT_EQ(line, "a");
  ASSERT_TRUE(lines.Next(line));
  EXPECT_EQ(line, "");
  EXPECT_EQ(lines.rest(), "b");
  ASSERT_TRUE(lines.Next(line));
  EXPECT_EQ(line, "b");
  EXPECT_EQ(lines.number(), 3u);
  EXPECT_FALSE(lines.Next(line));
}

TEST(Words, AreSeparatedByBlanksTabsAndCommas) {
  std::string_view line = " a,b\t ";
  EXPECT_EQ(NextWord(line), "a");
  EXPECT_EQ(NextWord(line), "b");
  EXPECT_EQ(NextWord(line), "");
}

TEST(Numbers, AreWholeWords) {
  EXPECT_EQ(ParseNumber("+1.5e-3"), 1.5e-3);
  EXPECT_TRUE(std::isnan(ParseNumber("nan").value()));
  for (const char* word : {"", "+", "+-1", "1x", "0x10", "1e999", " 1"})
    EXPECT_FALSE(ParseNumber(word)) << word;
  EXPECT_EQ(ParseInteger("-12"), -12);
  for (const char* word : {"", "1.0", "9223372036854775808"})
    EXPECT_FALSE(ParseInteger(word)) << word;
}

TEST(ParseJson, RefusesWhatIsMalformedOrDeep) {
  EXPECT_EQ(ParseJson("{\"a\": [1]}", "a.json").at("a").at(0).get<int>(), 1);
  EXPECT_THAT(Rejection([] { ParseJson("{", "a.json"); }), HasSubstr("a.json: not valid JSON"));
  const auto nested = [](int depth) {
    return std::string(depth, '[') + "1" + std::string(depth, ']');
  };
  EXPECT_NO_THROW(ParseJson(nested(16), "a.json"));
  EXPECT_THAT(Rejection([&] { ParseJson(nested(17), "a.json"); }), HasSubstr("deeper than 16"));
  EXPECT_THAT(Rejection([&] { ParseJson(nested(1000000), "a.json"); }), HasSubstr("deeper"));
  EXPECT_NO_THROW(
      ParseJson('"' + std::string(100, '[') + "\\\"" + std::string(100, '{') + '"', "a.json"));
}

// In quadratic time this would take hours.
TEST(ParseJson, TakesLinearTime) {
  std::string text = "[[0]";
  for (int i = 1; i < 1000000; ++i) text += ",[0]";
  EXPECT_EQ(ParseJson(text + "]", "a.json").size(), 1000000u);
}

}  // namespace
}  // namespace curvefusion
