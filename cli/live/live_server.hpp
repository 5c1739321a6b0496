// Serves a live view to the browsers of this machine, on 127.0.0.1 only. The address contains a random word: without it
// every answer is 404.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "cli/live/live_data.hpp"

namespace pulvis {

class PortTaken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class LiveServer {
 public:
  // `port` 0: any that is free. Throws PortTaken. Answers from now on, in threads of its own.
  LiveServer(LiveData& data, int port);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  const std::string& address() const { return address_; }

 private:
  class Threads;
  void answer(LiveData& data, const std::string& word);

  std::unique_ptr<Threads> threads_;
  std::string address_;
};

}  // namespace pulvis
