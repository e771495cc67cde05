#include "system/files/seal.hpp"

#include <cstdint>

#include "slipfront/error.hpp"
#include "system/files/whole_file.hpp"

namespace slipfront::record {
namespace {

constexpr std::string_view magic = "SLIPSEAL";
constexpr std::size_t seal_size = 24;

void append(std::string& text, std::uint64_t value) {
  for (int shift = 0; shift < 64; shift += 8) text += static_cast<char>(static_cast<unsigned char>(value >> shift));
}

}  // namespace

std::string seal(std::string_view content) {
  std::string text(magic);
  append(text, content.size());
  append(text, Fnv().bytes(content).sum());
  return text;
}

std::string_view without_broken_seal(std::string_view file, const std::string& name) {
  const bool sealed = file.size() >= seal_size && file.substr(file.size() - seal_size, magic.size()) == magic;
  return sealed ? sealed_content(file, name) : file;
}

void require_unbroken_seal(const std::string& path) { without_broken_seal(read_regular(path), path); }

std::string_view sealed_content(std::string_view file, const std::string& name) {
  if (file.empty()) throw FileError(name + ": the file is empty");
  if (file.substr(0, 8) != "\x89HDF\r\n\x1a\n") throw FileError(name + ": not a NetCDF-4 file");
  if (file.size() < seal_size || file.substr(file.size() - seal_size, magic.size()) != magic)
    throw FileError(name + ": has no seal at its end: not written by slipfront, or cut short or changed since");
  const std::string_view content = file.substr(0, file.size() - seal_size);
  if (file.substr(content.size()) != seal(content)) throw FileError(name + ": damaged: the checksum does not match");
  return content;
}

}  // namespace slipfront::record
