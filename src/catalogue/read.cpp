#include "slipfront/catalogue/read.hpp"

namespace slipfront::catalogue {
namespace {

enum class Format { toml, csv, fsp };

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// By name; else an .fsp starts with '%', and of the other two only TOML has a line that starts with '['.
Format format_of(std::string_view text, std::string_view file) {
  if (ends_with(file, ".toml")) return Format::toml;
  if (ends_with(file, ".csv")) return Format::csv;
  if (ends_with(file, ".fsp")) return Format::fsp;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text[first] == '%') return Format::fsp;
  if (first != std::string_view::npos && text[first] == '[') return Format::toml;
  return text.find("\n[") != std::string_view::npos ? Format::toml : Format::csv;
}

}  // namespace

std::vector<std::string> read_events(std::string_view text, const std::string& file, const Sink& sink) {
  try {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
      throw InputError({.file = file, .problem = "the file is empty", .allowed = "an event in TOML, CSV or .fsp"});
    switch (format_of(text, file)) {
      case Format::toml:
        sink({read_toml(text, file), {}});
        break;
      case Format::fsp:
        sink({read_fsp(text, file), {}});
        break;
      case Format::csv:
        return read_csv(text, file, sink);
    }
  } catch (const InputError& error) {
    Entry entry;
    entry.observation.name = file;
    entry.observation.file = file;
    entry.error = error.complaint();
    sink(std::move(entry));
  }
  return {};
}

}  // namespace slipfront::catalogue
