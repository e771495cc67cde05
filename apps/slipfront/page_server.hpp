#pragma once

#include <cstddef>
#include <list>
#include <string>
#include <vector>

#include "http_request.hpp"
#include "page_folder.hpp"

/// Serves the files of a folder over HTTP/1.1, in one thread and with bounded memory whatever clients do: it reads at
/// most 32 kB of a request and no body, sends files piece by piece, keeps at most 128 connections open, and answers one
/// request on each. A client that makes the server wait loses its connection after some seconds, or at once if all
/// connections are taken and another client comes.
class PageServer {
 public:
  struct Options {
    std::string address;          ///< name or address to listen on
    std::vector<int> ports = {};  ///< tried in this order; 0: any that is free
    bool anyone = false;          ///< other machines may connect, and any Host is accepted
  };

  /// Listens. \throws FileError if the address cannot be served, InputError if other machines reach it and `anyone` is
  /// false.
  PageServer(const std::string& folder, const Options& options);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  int port() const { return port_; }

  /// Runs until a signal ends the program. \throws FileError if no connection can be accepted any more.
  [[noreturn]] void serve();

 private:
  struct Connection;

  void wait();
  void expire();
  void accept_waiting();
  void drop_slowest();
  void advance(Connection& connection) const;
  void receive(Connection& connection) const;
  void answer(Connection& connection) const;
  PageFile requested_file(const HttpRequest& request) const;

  PageFolder folder_;
  Options options_;
  Descriptor listening_;
  std::size_t max_connections_;
  int port_ = 0;
  std::list<Connection> connections_;
};
