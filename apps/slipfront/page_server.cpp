#include "page_server.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <string_view>

#include "slipfront/error.hpp"

namespace {

using slipfront::FileError;
using slipfront::InputError;
using Clock = std::chrono::steady_clock;
using std::chrono::seconds;

constexpr std::size_t usual_connections = 128;  ///< a browser opens six
constexpr std::size_t max_request = 32768;      ///< bytes; cookies of other pages of this machine are sent here too
constexpr auto request_time = seconds(5), idle_time = seconds(10), drain_time = seconds(1);

/// The page loads only its own files, and no other page may show it in a frame. KaTeX writes styles into elements.
constexpr std::string_view common_fields =
    "Connection: close\r\n"
    "Cache-Control: no-cache\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "X-Frame-Options: DENY\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Content-Security-Policy: default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' "
    "'unsafe-inline'; img-src 'self' data: blob:; font-src 'self'; connect-src 'self'; worker-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n";

std::string_view reason(int status) {
  struct Known {
    int status;
    std::string_view text;
  };
  static constexpr std::array<Known, 8> known = {{{200, "OK"},
                                                  {403, "Forbidden"},
                                                  {404, "Not Found"},
                                                  {405, "Method Not Allowed"},
                                                  {408, "Request Timeout"},
                                                  {421, "Misdirected Request"},
                                                  {431, "Request Header Fields Too Large"},
                                                  {505, "HTTP Version Not Supported"}}};
  for (const Known& k : known)
    if (k.status == status) return k.text;
  return "Bad Request";
}

std::string_view media_type(std::string_view name) {
  struct Known {
    std::string_view extension, type;
  };
  static constexpr std::array<Known, 12> known = {{{"html", "text/html; charset=utf-8"},
                                                   {"js", "text/javascript"},
                                                   {"mjs", "text/javascript"},
                                                   {"css", "text/css"},
                                                   {"wasm", "application/wasm"},
                                                   {"json", "application/json"},
                                                   {"svg", "image/svg+xml"},
                                                   {"png", "image/png"},
                                                   {"ico", "image/x-icon"},
                                                   {"woff2", "font/woff2"},
                                                   {"csv", "text/csv"},
                                                   {"txt", "text/plain; charset=utf-8"}}};
  const std::string_view extension = name.substr(name.rfind('.') + 1);  // npos + 1 is 0: the whole name
  for (const Known& k : known)
    if (k.extension == extension) return k.type;
  return "application/octet-stream";
}

std::string head(int status, std::string_view type, long long size) {
  return fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n{}{}\r\n", status, reason(status),
                     type, size, status == 405 ? "Allow: GET, HEAD\r\n" : "", common_fields);
}

bool is_loopback(const sockaddr* address) {
  if (address->sa_family == AF_INET) {
    const auto* v4 = reinterpret_cast<const sockaddr_in*>(address);
    return ntohl(v4->sin_addr.s_addr) >> 24U == 127;
  }
  if (address->sa_family != AF_INET6) return false;
  const in6_addr& v6 = reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr;
  return IN6_IS_ADDR_LOOPBACK(&v6) || (IN6_IS_ADDR_V4MAPPED(&v6) && v6.s6_addr[12] == 127);
}

struct FreeAddresses {
  void operator()(addrinfo* list) const { freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

Addresses addresses_of(const PageServer::Options& options, int port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = getaddrinfo(options.address.c_str(), std::to_string(port).c_str(), &hints, &found))
    throw FileError(fmt::format("{} cannot be served: {}", options.address, gai_strerror(error)));
  Addresses list(found);
  for (const addrinfo* a = found; a; a = a->ai_next)
    if (!options.anyone && !is_loopback(a->ai_addr))
      throw InputError({.file = "command line",
                        .key = "--address",
                        .value = options.address,
                        .problem = "other machines could read the page there",
                        .allowed = "127.0.0.1, or --anyone to let them"});
  return list;
}

/// Listens on the first address where that is possible. Without SO_REUSEPORT, which would share a port that is taken.
Descriptor listen_on(const Addresses& addresses) {
  for (const addrinfo* a = addresses.get(); a; a = a->ai_next) {
    Descriptor s(socket(a->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, a->ai_protocol));
    const int yes = 1;
    if (!s || setsockopt(s.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0) continue;
    if (::bind(s.get(), a->ai_addr, a->ai_addrlen) == 0 && listen(s.get(), SOMAXCONN) == 0) return s;
  }
  return Descriptor();
}

int port_of(const Descriptor& listening) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (getsockname(listening.get(), reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  if (address.ss_family == AF_INET) return ntohs(reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
  return ntohs(reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port);
}

/// Names under which this machine reaches itself. A page of a stranger whose name has been made to point here (DNS
/// rebinding) comes with its own name. The port may differ: it does behind a tunnel.
bool is_own_host(const std::string& host, const std::string& address) {
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return ntohl(v4.s_addr) >> 24U == 127;
  return host == "localhost" || host == "[::1]" || host == address;
}

/// Each connection may need two descriptors: its own and that of a file.
std::size_t connections_within_limits() {
  constexpr rlim_t others = 10;  // streams, the socket that listens, the folder
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return usual_connections;
  const rlim_t possible = limit.rlim_cur > others + 2 ? (limit.rlim_cur - others) / 2 : 1;
  return std::min<std::size_t>(usual_connections, possible);
}

bool must_wait(ssize_t result) { return result < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR); }

std::array<char, 65536>& scratch() {
  static std::array<char, 65536> buffer;
  return buffer;
}

}  // namespace

struct PageServer::Connection {
  enum class Phase { receiving, sending, draining, closed };

  explicit Connection(Descriptor s) : socket(std::move(s)) {}

  void answer_with(std::string text, PageFile content = {}) {
    request.clear();
    request.shrink_to_fit();
    answer = std::move(text);
    file = std::move(content);
    enter(Phase::sending);
  }
  void enter(Phase next) {
    phase = next;
    since = Clock::now();
  }
  bool is_late(Clock::time_point now) const {
    const auto allowed = phase == Phase::receiving ? request_time : phase == Phase::sending ? idle_time : drain_time;
    return now - since > allowed;
  }
  void send_more();
  void drain();

  Descriptor socket;
  Phase phase = Phase::receiving;
  Clock::time_point since = Clock::now();  ///< beginning of the phase, or the last time that the client took bytes
  std::string request, answer;
  std::size_t answered = 0;  ///< bytes of `answer` that have been sent
  PageFile file;
  long long offset = 0;  ///< bytes of `file` that have been sent
};

/// Sends the next piece. When all is sent, the client is read until it closes: what it has sent but nobody has read
/// would otherwise make the system discard the answer.
void PageServer::Connection::send_more() {
  std::string_view piece = std::string_view(answer).substr(answered);
  if (piece.empty() && file.descriptor && offset < file.size) {
    auto& buffer = scratch();
    const auto wanted = std::min(static_cast<std::size_t>(file.size - offset), buffer.size());
    const ssize_t size = pread(file.descriptor.get(), buffer.data(), wanted, offset);
    if (size <= 0) return enter(Phase::closed);  // the file has become shorter
    piece = {buffer.data(), static_cast<std::size_t>(size)};
  }
  if (piece.empty()) {
    shutdown(socket.get(), SHUT_WR);
    return enter(Phase::draining);
  }
  const ssize_t sent = ::send(socket.get(), piece.data(), piece.size(), MSG_NOSIGNAL);
  if (must_wait(sent)) return;
  if (sent < 0) return enter(Phase::closed);
  since = Clock::now();
  if (answered < answer.size())
    answered += static_cast<std::size_t>(sent);
  else
    offset += sent;
}

void PageServer::Connection::drain() {
  const ssize_t size = recv(socket.get(), scratch().data(), scratch().size(), 0);
  if (size == 0 || (size < 0 && !must_wait(size))) enter(Phase::closed);
}

PageServer::PageServer(const std::string& folder, const Options& options)
    : folder_(folder), options_(options), max_connections_(connections_within_limits()) {
  for (const int port : options.ports) {
    listening_ = listen_on(addresses_of(options, port));
    if (!listening_) continue;
    port_ = port_of(listening_);
    return;
  }
  const int asked = options.ports.empty() ? 0 : options.ports[0];
  throw FileError(fmt::format("{}:{} cannot be served (is the port taken?)", options.address, asked));
}

PageServer::~PageServer() = default;

PageFile PageServer::requested_file(const HttpRequest& request) const {
  if (!options_.anyone && !is_own_host(request.host, options_.address))
    throw RefusedRequest(421, "This server does not answer for that host.");
  PageFile file = folder_.open(request.path);
  if (!file.descriptor) throw RefusedRequest(404, "There is no such file.");
  return file;
}

void PageServer::answer(Connection& connection) const {
  try {
    const HttpRequest request = parse_request(connection.request);
    PageFile file = requested_file(request);
    std::string text = head(200, media_type(request.path.back()), file.size);
    connection.answer_with(std::move(text), request.head_only ? PageFile() : std::move(file));
  } catch (const RefusedRequest& refused) {
    const std::string_view text = refused.what();
    const auto size = static_cast<long long>(text.size());
    std::string answer = head(refused.status(), "text/plain; charset=utf-8", size);
    if (connection.request.rfind("HEAD ", 0) != 0) answer += text;
    connection.answer_with(std::move(answer));
  }
}

void PageServer::receive(Connection& connection) const {
  std::string& text = connection.request;
  const ssize_t size = recv(connection.socket.get(), scratch().data(), max_request - text.size(), 0);
  if (must_wait(size)) return;
  if (size <= 0) return connection.enter(Connection::Phase::closed);
  const std::size_t seen = text.size() < 3 ? 0 : text.size() - 3;
  text.append(scratch().data(), static_cast<std::size_t>(size));
  if (text.find("\r\n\r\n", seen) != std::string::npos) return answer(connection);
  if (text.size() < max_request) return;
  connection.answer_with(head(431, "text/plain", 0));
}

void PageServer::advance(Connection& connection) const {
  using Phase = Connection::Phase;
  if (connection.phase == Phase::receiving)
    receive(connection);
  else if (connection.phase == Phase::sending)
    connection.send_more();
  else if (connection.phase == Phase::draining)
    connection.drain();
}

/// Waits until a connection or a new client can be served, and serves them.
void PageServer::wait() {
  std::vector<pollfd> waiting = {{.fd = listening_.get(), .events = POLLIN, .revents = 0}};
  for (const Connection& c : connections_) {
    const short events = c.phase == Connection::Phase::sending ? POLLOUT : POLLIN;
    waiting.push_back({.fd = c.socket.get(), .events = events, .revents = 0});
  }
  const int tick = connections_.empty() ? -1 : 200;
  if (poll(waiting.data(), waiting.size(), tick) < 0) {
    if (errno == EINTR) return;
    throw FileError(std::string("connections can no longer be served: ") + std::strerror(errno));
  }
  std::size_t i = 0;
  for (Connection& c : connections_)
    if (waiting[++i].revents != 0) advance(c);
  if (waiting[0].revents != 0) accept_waiting();
}

void PageServer::expire() {
  const auto now = Clock::now();
  for (Connection& c : connections_) {
    if (!c.is_late(now)) continue;
    const bool has_asked = c.phase == Connection::Phase::receiving && !c.request.empty();
    if (has_asked)
      c.answer_with(head(408, "text/plain", 0));
    else
      c.enter(Connection::Phase::closed);
  }
  connections_.remove_if([](const Connection& c) { return c.phase == Connection::Phase::closed; });
}

void PageServer::drop_slowest() {
  const auto earlier = [](const Connection& a, const Connection& b) { return a.since < b.since; };
  const auto slowest = std::min_element(connections_.begin(), connections_.end(), earlier);
  if (slowest != connections_.end()) connections_.erase(slowest);
}

void PageServer::accept_waiting() {
  const std::size_t in_a_turn = std::max<std::size_t>(1, max_connections_ / 2);  // so that each has a turn to ask
  for (std::size_t i = 0; i < in_a_turn; ++i) {
    Descriptor client(accept4(listening_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!client) {
      if (errno == EAGAIN || errno == EWOULDBLOCK) return;
      if (errno == EINTR || errno == ECONNABORTED || errno == EPROTO) continue;
      const bool is_full = errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM;
      if (!is_full || connections_.empty())
        throw FileError(std::string("connections can no longer be accepted: ") + std::strerror(errno));
      drop_slowest();
      continue;
    }
    if (connections_.size() >= max_connections_) drop_slowest();
    connections_.emplace_back(std::move(client));
    advance(connections_.back());  // its request is usually there
  }
}

void PageServer::serve() {
  for (;;) {
    wait();
    expire();
  }
}
