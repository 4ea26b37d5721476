#include "kernel/text_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "kernel/error.h"
#include "kernel/json_input.h"
#include "tests/error_message.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;

// The message of the Error(kBadInput) that `call` throws.
template <class Call>
std::string Rejection(const Call& call) {
  return MessageOf(ErrorKind::kBadInput, call);
}

TEST(ReadFile, GivesEveryByteUpToTheLimit) {
  const std::filesystem::path path = TemporaryPath("read_file");
  const std::string content = std::string("a\r\n\0b", 5) + std::string(200000, 'c');
  std::ofstream(path, std::ios::binary) << content;
  EXPECT_EQ(ReadFile(path), content);
  EXPECT_EQ(ReadFile(path, content.size()), content);
  EXPECT_THAT(Rejection([&] { ReadFile(path, content.size() - 1); }), HasSubstr("is larger than"));
  std::filesystem::remove(path);
}

TEST(ReadFile, TellsWhyAPathIsNoFile) {
  const std::filesystem::path path = TemporaryPath("no_file");
  EXPECT_THAT(Rejection([&] { ReadFile(path); }), HasSubstr("is not there"));
  EXPECT_THAT(Rejection([&] { ReadFile(path.parent_path()); }), HasSubstr("is a folder"));
  EXPECT_THAT(Rejection([&] { ReadFile("/dev/zero"); }), HasSubstr("is a pipe or a device"));
  // Nobody writes to it: opening it would wait for ever.
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_THAT(Rejection([&] { ReadFile(path); }), HasSubstr("is a pipe or a device"));
  std::filesystem::remove(path);
}

TEST(ReadFile, TellsThatAFileIsNotReadable) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const std::filesystem::path path = TemporaryPath("unreadable");
  std::ofstream(path) << "a";
  std::filesystem::permissions(path, std::filesystem::perms::none);
  EXPECT_THAT(Rejection([&] { ReadFile(path); }), HasSubstr("cannot be read (Permission denied)"));
  std::filesystem::remove(path);
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

TEST(ParseJson, TellsThePlaceInPlainWords) {
  const auto message = [](const std::string& text) {
    return Rejection([&] { ParseJson(text, "a.json"); });
  };
  EXPECT_THAT(message("{\"a\": 1,\n \"b\": x}"),
              HasSubstr("a.json: not valid JSON: line 2, column 7: 'x' does not belong here"));
  EXPECT_THAT(message("[1, 2"), HasSubstr("line 1, column 6: the text ends too early"));
  EXPECT_THAT(message("[\"\xff\"]"), HasSubstr("line 1, column 3: a byte that is not UTF-8"));
  EXPECT_THAT(message("[\"a\nb\"]"), HasSubstr("line break or control character within quotes"));
  EXPECT_THAT(message("[1e999]"), HasSubstr("a number of more than 1.8e308"));
  EXPECT_THAT(message("[1] 2"), HasSubstr("after the end of the value"));
  for (const char* text : {"", "x", "[1,]", "{'a':1}", "[01]", "[\"\\x\"]", "[1] // c", "[tru]"}) {
    EXPECT_THAT(message(text), testing::Not(HasSubstr("exception"))) << text;
    EXPECT_THAT(message(text), testing::Not(HasSubstr("parse"))) << text;
  }
}

// In quadratic time this would take hours.
TEST(ParseJson, TakesLinearTime) {
  std::string text = "[[0]";
  for (int i = 1; i < 1000000; ++i) text += ",[0]";
  EXPECT_EQ(ParseJson(text + "]", "a.json").size(), 1000000u);
}

}  // namespace
}  // namespace curvefusion
