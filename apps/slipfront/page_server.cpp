#include "page_server.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <limits>
#include <list>
#include <string_view>
#include <utility>

#include "page_folder.hpp"
#include "page_path.hpp"
#include "slipfront/error.hpp"

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;
using slipfront::FileError;
using slipfront::InputError;
using Clock = std::chrono::steady_clock;
using std::chrono::seconds;
using Request = http::request<http::empty_body>;

constexpr std::size_t usual_connections = 128;  ///< a browser opens six
constexpr std::size_t max_request = 32768;      ///< bytes; cookies of other pages of this machine are sent here too
constexpr long long max_piece = 65536;          ///< bytes of a file that are sent at a time
constexpr auto request_time = seconds(5), idle_time = seconds(30), drain_time = seconds(1);

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

std::string head(unsigned status, std::string_view type, long long size) {
  return fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n{}{}\r\n", status,
                     http::obsolete_reason(http::int_to_status(status)).to_string(), type, size,
                     status == 405 ? "Allow: GET, HEAD\r\n" : "", common_fields);
}

std::string_view media_type(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 12> known = {
      {{".html", "text/html; charset=utf-8"},
       {".js", "text/javascript"},
       {".mjs", "text/javascript"},
       {".css", "text/css"},
       {".wasm", "application/wasm"},
       {".json", "application/json"},
       {".svg", "image/svg+xml"},
       {".png", "image/png"},
       {".ico", "image/x-icon"},
       {".woff2", "font/woff2"},
       {".csv", "text/csv"},
       {".txt", "text/plain; charset=utf-8"}}};
  for (const auto& [extension, type] : known)
    if (name.ends_with(extension)) return type;
  return "application/octet-stream";
}

/// The host without its port. An IPv6 address keeps its brackets.
std::string host_name(const std::string& host) {
  const std::size_t begin = host.empty() || host[0] != '[' ? 0 : std::min(host.find(']'), host.size());
  return host.substr(0, host.find(':', begin));
}

/// Names under which this machine reaches itself. A page of a stranger whose name has been made to point here (DNS
/// rebinding) comes with its own name. The port may differ: it does behind a tunnel.
bool is_own_host(const std::string& host, const std::string& address) {
  error_code error;
  const auto v4 = asio::ip::make_address_v4(host, error);
  if (!error) return v4.is_loopback();
  return beast::iequals(host, "localhost") || host == "[::1]" || beast::iequals(host, address);
}

/// Ranges are ignored, which RFC 9110 allows: the whole file is sent. \throws RefusedRequest where the text is not
/// HTTP/1, or the method is not GET or HEAD.
Request parsed(const std::string& text) {
  http::request_parser<http::empty_body> parser;
  parser.header_limit(max_request);
  parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // bodies are not read
  error_code error;
  parser.put(asio::buffer(text), error);
  if (error == http::error::bad_version) throw RefusedRequest(505, "Only HTTP/1 is spoken here.");
  if (error) throw RefusedRequest(400, "The request is not HTTP.");
  const http::verb method = parser.get().method();
  if (method == http::verb::get || method == http::verb::head) return parser.release();
  throw RefusedRequest(405, "Only GET and HEAD are allowed.");
}

/// \throws RefusedRequest where a page of another origin asks, or the request is for another host.
void check(const Request& request, const PageAddress& allowed) {
  const std::string host(request[http::field::host]);
  if (request.count(http::field::host) != 1 || host_name(host).empty())
    throw RefusedRequest(400, "The request needs one Host header.");
  for (auto [origin, end] = request.equal_range(http::field::origin); origin != end; ++origin)
    if (!beast::iequals(origin->value(), "http://" + host) && !beast::iequals(origin->value(), "https://" + host))
      throw RefusedRequest(403, "Pages of other origins may not ask here.");
  if (!allowed.anyone && !is_own_host(host_name(host), allowed.address))
    throw RefusedRequest(421, "This server does not answer for that host.");
}

struct Page {
  PageFolder folder;
  PageAddress address;
};

/// Answers one request. Each operation that is under way holds a reference to it.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(const Page& page, tcp::socket socket)
      : page_(page), socket_(std::move(socket)), timer_(socket_.get_executor()) {}

  /// The parser gets only whole requests: Beast bounds the size of each piece of a header but not their sum.
  void receive() {
    allow(request_time);
    async_read_until(socket_, asio::dynamic_buffer(text_, max_request), "\r\n\r\n",
                     [self = shared_from_this()](error_code error, std::size_t) { self->reply(error); });
  }

  /// Time of the last progress, or of the beginning of the request.
  Clock::time_point since() const { return since_; }

  void close() {
    error_code ignored;
    socket_.close(ignored);
  }

 private:
  /// The client has this time until the next call. While it sends its request, only reading ends then, so that it can
  /// still be answered.
  void allow(seconds time) {
    since_ = Clock::now();
    timer_.expires_after(time);
    timer_.async_wait([weak = weak_from_this()](error_code error) {
      const auto self = weak.lock();
      if (error || !self || self->timer_.expiry() > Clock::now()) return;
      self->is_receiving_ ? self->socket_.shutdown(tcp::socket::shutdown_receive, error) : self->socket_.close(error);
    });
  }

  void reply(error_code error) {
    is_receiving_ = false;
    const bool is_cut = error == asio::error::eof && !text_.empty();
    if (error && !is_cut && error != asio::error::not_found) return;
    const bool head_only = text_.starts_with("HEAD ");
    try {
      if (is_cut) throw RefusedRequest(408, "The request was not complete in time.");
      if (error) throw RefusedRequest(431, "The request is too long.");
      const Request request = parsed(text_);
      check(request, page_.address);
      const std::vector<std::string> path = page_path(request.target().to_string());
      file_ = page_.folder.open(path);
      if (!file_.descriptor) throw RefusedRequest(404, "There is no such file.");
      text_ = head(200, media_type(path.back()), file_.size);
    } catch (const RefusedRequest& refused) {
      const std::string_view reason = refused.what();
      text_ = head(refused.status(), "text/plain; charset=utf-8", static_cast<long long>(reason.size()));
      if (!head_only) text_ += reason;
    }
    if (head_only) file_ = {};
    send();
  }

  /// Sends the text and then the next piece of the file, until there is none.
  void send() {
    allow(idle_time);
    async_write(socket_, asio::buffer(text_), [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return;
      if (self->read_more()) return self->send();
      self->socket_.shutdown(tcp::socket::shutdown_send, error);
      self->allow(drain_time);
      self->drain();
    });
  }

  /// Returns false at the end of the file.
  bool read_more() {
    if (file_.size == 0 || !file_.descriptor) return false;
    text_.resize(static_cast<std::size_t>(std::min<long long>(file_.size, max_piece)));
    const ssize_t size = read(file_.descriptor.get(), text_.data(), text_.size());
    text_.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    file_.size -= size;
    return size > 0;
  }

  /// Reads the client until it closes: what it has sent but nobody has read would otherwise make the system discard
  /// the answer.
  void drain() {
    static std::array<char, 65536> unused;
    socket_.async_read_some(asio::buffer(unused), [self = shared_from_this()](error_code error, std::size_t) {
      if (!error) self->drain();
    });
  }

  const Page& page_;
  tcp::socket socket_;
  asio::steady_timer timer_;
  Clock::time_point since_;
  std::string text_;  ///< the request, then a piece of the answer
  PageFile file_;     ///< its size is that of the rest
  bool is_receiving_ = true;
};

/// Each connection may need two descriptors: its own and that of a file.
std::size_t connections_within_limits() {
  constexpr rlim_t others = 12;  // streams, the socket that listens, the folder, those of Asio
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return usual_connections;
  const rlim_t possible = limit.rlim_cur > others + 2 ? (limit.rlim_cur - others) / 2 : 1;
  return std::min<std::size_t>(usual_connections, possible);
}

/// Listens on the first endpoint of the address where that is possible.
tcp::acceptor listen(asio::io_context& context, const PageAddress& a, int port) {
  error_code error;
  const auto found =
      tcp::resolver(context).resolve(a.address, std::to_string(port), tcp::resolver::numeric_service, error);
  if (error) throw FileError(fmt::format("{} cannot be served: {}", a.address, error.message()));
  for (const auto& entry : found)
    if (!a.anyone && !entry.endpoint().address().is_loopback())
      throw InputError({.file = "command line",
                        .key = "--address",
                        .value = a.address,
                        .problem = "other machines could read the page there",
                        .allowed = "127.0.0.1, or --anyone to let them"});
  for (const auto& entry : found) {
    try {
      return tcp::acceptor(context, entry.endpoint());
    } catch (const boost::system::system_error&) {  // the next one may do
    }
  }
  return tcp::acceptor(context);
}

class Server {
 public:
  Server(const std::string& folder, const PageAddress& a) : page_{.folder = PageFolder(folder), .address = a} {
    for (std::size_t i = 0; i < a.ports.size() && !acceptor_.is_open(); ++i)
      acceptor_ = listen(context_, a, a.ports[i]);
    if (!acceptor_.is_open())
      throw FileError(fmt::format("{}:{} cannot be served (is the port taken?)", a.address, a.ports.at(0)));
    fcntl(acceptor_.native_handle(), F_SETFD, FD_CLOEXEC);  // a browser must not inherit it
    accept();
  }
  int port() const { return acceptor_.local_endpoint().port(); }
  void run() { context_.run(); }

 private:
  void accept() {
    acceptor_.async_accept([this](error_code error, tcp::socket client) {
      connections_.remove_if([](const auto& c) { return c.expired(); });
      if (error && connections_.empty()) throw FileError("connections can no longer be accepted: " + error.message());
      if (error || connections_.size() >= max_connections_) drop_slowest();
      if (!error) {
        auto connection = std::make_shared<Connection>(page_, std::move(client));
        connections_.push_back(connection);
        connection->receive();
      }
      accept();
    });
  }

  void drop_slowest() {
    const auto earlier = [](const auto& a, const auto& b) { return a.lock()->since() < b.lock()->since(); };
    const auto slowest = std::min_element(connections_.begin(), connections_.end(), earlier);
    slowest->lock()->close();
    connections_.erase(slowest);
  }

  Page page_;
  asio::io_context context_{1};
  tcp::acceptor acceptor_{context_};
  std::list<std::weak_ptr<Connection>> connections_;
  const std::size_t max_connections_ = connections_within_limits();
};

}  // namespace

void serve_page(const std::string& folder, const PageAddress& address, const std::function<void(int)>& when_ready) {
  Server server(folder, address);
  when_ready(server.port());
  for (;;) server.run();
}
