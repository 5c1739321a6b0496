#include "cli/live/live_server.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/random.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "cli/report/report.hpp"

namespace pulvis {
namespace {

constexpr const char* host = "127.0.0.1";
constexpr std::size_t most_answers = 24;  // at a time; each open page waits for one

std::string random_word() {
  std::array<std::uint64_t, 2> bits{};
  if (getrandom(bits.data(), sizeof bits, 0) != static_cast<ssize_t>(sizeof bits))
    throw std::system_error(errno, std::generic_category(), "random address of the live view");
  return fmt::format("{:016x}{:016x}", bits[0], bits[1]);
}

// The library lets a second server share the port of a first, which then gets some of its questions.
void use_alone(socket_t socket) {
  const int yes = 1;  // also where closed connections of an earlier server linger
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

// The library would compress a text in one piece with Brotli at its slowest, for a minute.
void send(httplib::Response& response, std::string text, const char* type) {
  const auto kept = std::make_shared<const std::string>(std::move(text));
  response.set_content_provider(
      kept->size(), type, [kept](std::size_t from, std::size_t length, httplib::DataSink& to) {
        return to.write(kept->data() + from, length);
      });
}

std::int64_t known_version(const httplib::Request& request) {
  const std::string text = request.get_param_value("since");
  std::int64_t version = 0;
  std::from_chars(text.data(), text.data() + text.size(), version);
  return version;
}

}  // namespace

class LiveServer::Threads {
 public:
  httplib::Server server;
  std::thread listens{};
};

LiveServer::LiveServer(LiveData& data, int port) : threads_(std::make_unique<Threads>()) {
  httplib::Server& server = threads_->server;
  server.set_socket_options(use_alone);
  server.new_task_queue = [] { return new httplib::ThreadPool(most_answers); };
  const std::string word = random_word();
  answer(data, word);
  const bool bound =
      port == 0 ? (port = server.bind_to_any_port(host)) > 0 : server.bind_to_port(host, port);
  if (!bound)
    throw PortTaken(fmt::format(
        "pulvis: the live view cannot use port {} of {}: another program uses it, or it is "
        "reserved; allowed: --port with another one, or without --port any that is free",
        port, host));
  address_ = fmt::format("http://{}:{}/{}/", host, port, word);
  threads_->listens = std::thread([&server] { server.listen_after_bind(); });
}

LiveServer::~LiveServer() {
  while (!threads_->server.is_running()) std::this_thread::yield();  // it cannot be stopped before
  threads_->server.stop();
  threads_->listens.join();
}

void LiveServer::answer(LiveData& data, const std::string& word) {
  httplib::Server& server = threads_->server;
  constexpr const char* json = "application/json";
  server.set_default_headers({{"Cache-Control", "no-store"},
                              {"Referrer-Policy", "no-referrer"},
                              {"X-Content-Type-Options", "nosniff"}});
  const std::string page = live_page();
  server.Get("/" + word + "/", [page](const httplib::Request&, httplib::Response& response) {
    send(response, page, "text/html; charset=utf-8");
  });
  server.Get("/" + word, [word](const httplib::Request&, httplib::Response& response) {
    response.set_redirect("/" + word + "/");
  });
  server.Get("/" + word + "/state",
             [&data](const httplib::Request& request, httplib::Response& response) {
               send(response, data.state(known_version(request)), json);
             });
  server.Get("/" + word + "/report",
             [&data](const httplib::Request& request, httplib::Response& response) {
               send(response, data.report(known_version(request)), json);
             });
}

}  // namespace pulvis
