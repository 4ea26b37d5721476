#include "apps/live/live_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "apps/live/live_json.h"
#include "apps/page_parts.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr const char* kLoopback = "127.0.0.1";
// Answers are short and few: a page asks twice a second.
constexpr size_t kThreads = 2;
constexpr double kWatchedSeconds = 3;

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Otherwise the page of any site could read here by giving its own name this address (DNS
// rebinding).
bool AsksForThisServer(const httplib::Request& request, int port) {
  const std::string host = request.get_header_value("Host");
  return host == fmt::format("{}:{}", kLoopback, port) || host == fmt::format("localhost:{}", port);
}

}  // namespace

struct LiveServer::Impl {
  httplib::Server server;
  int port = 0;
  std::atomic<double> last_asked{0};
  std::atomic<bool> has_ended{false};
  std::thread thread;

  void Answer(const LiveBoard& board);
  void Bind(int wanted);
};

// Browsers must not keep what they got: it is another at each time.
void LiveServer::Impl::Answer(const LiveBoard& board) {
  server.set_default_headers(
      {{"Cache-Control", "no-store"}, {"X-Content-Type-Options", "nosniff"}});
  server.set_pre_routing_handler(
      [this](const httplib::Request& request, httplib::Response& response) {
        if (AsksForThisServer(request, port)) return httplib::Server::HandlerResponse::Unhandled;
        response.status = 403;
        return httplib::Server::HandlerResponse::Handled;
      });
  server.Get("/", [](const httplib::Request&, httplib::Response& response) {
    response.set_content(AssemblePage("live.html", ""), "text/html; charset=utf-8");
  });
  server.Get("/state.json", [this, &board](const httplib::Request&, httplib::Response& response) {
    last_asked = Now();
    response.set_content(StateJson(board.state()).dump(), "application/json");
  });
  server.Get("/curves.json", [&board](const httplib::Request&, httplib::Response& response) {
    response.set_content(board.curves(), "application/json");
  });
}

void LiveServer::Impl::Bind(int wanted) {
  if (wanted == 0) {
    port = server.bind_to_any_port(kLoopback);
  } else if (server.bind_to_port(kLoopback, wanted)) {
    port = wanted;
  }
  if (port > 0) return;
  throw Error(ErrorKind::kResource,
              fmt::format("port {} of {} cannot be had: another program may use it; name another "
                          "one, or 0 for any that is free (--port 0)",
                          wanted, kLoopback));
}

LiveServer::LiveServer(int port, const LiveBoard& board) : impl_(std::make_unique<Impl>()) {
  httplib::Server& server = impl_->server;
  server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
  // Not SO_REUSEPORT, by which two runs would share a port.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  });
  server.set_keep_alive_max_count(1);  // a connection that waits would hold one of the threads
  impl_->Answer(board);
  impl_->Bind(port);
  impl_->thread = std::thread([this] {
    impl_->server.listen_after_bind();
    impl_->has_ended = true;
  });
}

LiveServer::~LiveServer() {
  // One that does not listen yet would not hear of the end.
  while (!impl_->server.is_running() && !impl_->has_ended) std::this_thread::yield();
  impl_->server.stop();
  impl_->thread.join();
}

int LiveServer::port() const { return impl_->port; }

std::string LiveServer::address() const { return fmt::format("http://{}:{}/", kLoopback, port()); }

bool LiveServer::IsWatched() const { return Now() - impl_->last_asked < kWatchedSeconds; }

}  // namespace curvefusion
