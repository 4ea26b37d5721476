#pragma once

#include <memory>
#include <string>

#include "apps/live/live_board.h"

namespace curvefusion {

/// Shows a live run in browsers of this machine: answers on the loopback interface only, with what
/// the board holds at that moment. `/` is the page, `/state.json` and `/curves.json` what it asks
/// for again and again.
class LiveServer {
 public:
  /// Port 0 takes any that is free. The board must outlive the server. Throws Error(kResource)
  /// where the port is taken.
  LiveServer(int port, const LiveBoard& board);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  int port() const;
  /// "http://127.0.0.1:8700/".
  std::string address() const;
  /// Whether a page has asked for the state within the last seconds.
  bool IsWatched() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace curvefusion
