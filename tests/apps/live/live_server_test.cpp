#include "apps/live/live_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <nlohmann/json.hpp>
#include <string>

#include "kernel/error.h"

namespace curvefusion {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

httplib::Result Get(const LiveServer& server, const char* path) {
  return httplib::Client("127.0.0.1", server.port()).Get(path);
}

TEST(LiveServer, AnswersWithWhatTheBoardHoldsAtThatMoment) {
  LiveBoard board;
  const LiveServer server(0, board);
  ASSERT_GT(server.port(), 0);
  EXPECT_FALSE(server.IsWatched());
  auto answer = Get(server, "/state.json");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->get_header_value("Cache-Control"), "no-store");
  EXPECT_EQ(json::parse(answer->body)["phase"], "waiting");
  EXPECT_TRUE(server.IsWatched());
  board.Update([](LiveState& state) {
    state.phase = LivePhase::kScanning;
    state.dropped = 7;
    state.camera = {640, 480, 500, 500, 320, 240};
    state.T_world_camera = RigidTransform(Eigen::Translation3d(0, 0, 0.5));
  });
  board.SetCurves(R"({"number":3})");
  answer = Get(server, "/state.json");
  const json state = json::parse(answer->body);
  EXPECT_EQ(state["phase"], "scanning");
  EXPECT_EQ(state["frames"]["dropped"], 7);
  EXPECT_EQ(state["camera"]["T_camera_world"][2][3], -500);  // millimetres
  EXPECT_EQ(Get(server, "/curves.json")->body, R"({"number":3})");
}

TEST(LiveServer, ThePageIsWhole) {
  LiveBoard board;
  const LiveServer server(0, board);
  const auto page = Get(server, "/");
  ASSERT_TRUE(page);
  EXPECT_THAT(page->get_header_value("Content-Type"), HasSubstr("text/html"));
  EXPECT_THAT(page->body, HasSubstr("connect-src 'self'"));
  for (const char* part : {"LivePage", "CurveViewer", "Orbit", "Tubes", ".hint-key"}) {
    EXPECT_THAT(page->body, HasSubstr(part));
  }
  for (const char* left : {"{{live.js}}", "{{viewer.js}}", "{{style.css}}"}) {
    EXPECT_THAT(page->body, Not(HasSubstr(left)));
  }
  EXPECT_EQ(Get(server, "/elsewhere")->status, 404);
}

// A site whose name leads to this machine is not answered.
TEST(LiveServer, OtherNamesOfThisMachineAreRefused) {
  LiveBoard board;
  const LiveServer server(0, board);
  httplib::Client client("127.0.0.1", server.port());
  const auto status_for = [&](const std::string& name, int port) {
    const std::string host = name + ":" + std::to_string(port);
    return client.Get("/state.json", httplib::Headers{{"Host", host}})->status;
  };
  for (const char* name : {"localhost", "127.0.0.1"}) {
    EXPECT_EQ(status_for(name, server.port()), 200) << name;
    EXPECT_EQ(status_for(name, 1), 403) << name;
  }
  for (const char* name : {"elsewhere.example", "localhost.elsewhere.example", ""}) {
    EXPECT_EQ(status_for(name, server.port()), 403) << name;
  }
}

TEST(LiveServer, APortThatIsTakenIsRefused) {
  LiveBoard board;
  const LiveServer first(0, board);
  try {
    const LiveServer second(first.port(), board);
    FAIL() << "both have port " << first.port();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    EXPECT_THAT(error.what(), HasSubstr(std::to_string(first.port())));
  }
}

TEST(LiveServer, EndsAtOnceWithoutHavingBeenAsked) {
  LiveBoard board;
  for (int i = 0; i < 20; ++i) const LiveServer server(0, board);
}

}  // namespace
}  // namespace curvefusion
