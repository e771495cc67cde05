#include "slipfront/events/catalogue/read.hpp"

#include <iterator>

#include "events/catalogue/fault_model.hpp"
#include "events/catalogue/format.hpp"
#include "text/file_kind.hpp"

namespace slipfront::catalogue {

extern const Format json_format, toml_format, csv_format;

namespace {

/// In the order in which a text of unknown ending is tried; the last one takes what is left.
constexpr const Format* formats[] = {&fault_format, &json_format, &toml_format, &csv_format};

const Format& format_of(std::string_view text, std::string_view file) {
  if (is_fault_model(text)) return fault_format;  // also with the ending of a table
  for (const Format* format : formats)
    if (file.ends_with(format->ending)) return *format;
  for (const Format* format : formats)
    if (format->looks_like(text)) return *format;
  return **std::prev(std::end(formats));
}

}  // namespace

TableNotes read_events(std::string_view text, const std::string& file, const Sink& sink, const TableOptions& options) {
  try {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
      throw InputError({.file = file,
                        .problem = "the file is empty",
                        .allowed = "an event in TOML, CSV or GeoJSON, or a finite-fault model"});
    refuse_other_kinds(text, file, ReadAs::events);
    return format_of(text, file).read(text, file, sink, options);
  } catch (const InputError& error) {
    Entry entry;
    entry.observation.name = file;
    entry.observation.file = file;
    entry.error = error.complaint();
    sink(std::move(entry));
  }
  return {};
}

TableDescription describe_table(std::string_view text, const std::string& file, const TableOptions& options) {
  refuse_other_kinds(text, file, ReadAs::events);
  const Format* format = &format_of(text, file);
  if (format == &fault_format)
    throw InputError({.file = file,
                      .problem = "a finite-fault model, whose columns need no map",
                      .allowed = "slipfront event FILE; or a table with one event a row"});
  if (format != &csv_format)
    throw InputError({.file = file, .problem = "not a table", .allowed = "a table with columns (CSV)"});
  return describe_csv(text, file, options);
}

}  // namespace slipfront::catalogue
