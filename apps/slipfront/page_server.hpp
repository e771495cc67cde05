#pragma once

#include <functional>
#include <string>
#include <vector>

struct PageAddress {
  std::string address;          ///< name or address to listen on
  std::vector<int> ports = {};  ///< tried in this order; 0: any that is free
  bool anyone = false;          ///< other machines may connect, and any Host is accepted
};

/// Serves the files of a folder over HTTP/1.1 until a signal ends the program, in one thread and with bounded memory
/// whatever clients do: it reads at most 32 kB of a request and no body, sends files piece by piece, keeps at most 128
/// connections open, and answers one request on each. A client that makes the server wait loses its connection after
/// some seconds, or at once if all connections are taken and another client comes.
/// \param when_ready is called with the port as soon as it listens.
/// \throws FileError if the address cannot be served or no connection can be accepted any more, InputError if other
/// machines reach the address and `anyone` is false.
[[noreturn]] void serve_page(const std::string& folder, const PageAddress& address,
                             const std::function<void(int)>& when_ready);
