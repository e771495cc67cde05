#include "text/csv_records.hpp"

#include <csv.h>

#include <exception>
#include <new>

#include "slipfront/error.hpp"

namespace slipfront {
namespace {

/// More columns than any table has. The limit exists because looking up columns takes a time that grows with the square
/// of their number.
constexpr std::size_t most_columns = 10000;

struct Records {
  const std::function<void(std::vector<std::string>&&, std::size_t)>& take;
  std::vector<std::string> fields = {};
  std::size_t line = 0;               ///< number of the line that the parser gets
  std::size_t first = 0;              ///< line on which the current record begins; 0 between records
  std::exception_ptr exception = {};  ///< stored, because it must not pass through C code
};

void on_field(void* data, std::size_t size, void* self) {
  auto& records = *static_cast<Records*>(self);
  if (records.exception) return;
  try {
    if (records.fields.size() == most_columns)
      throw InputError({.line = records.first > 0 ? records.first : records.line,
                        .problem = "more than " + std::to_string(most_columns) + " columns",
                        .allowed = "fewer"});
    records.fields.emplace_back(data ? static_cast<const char*>(data) : "", data ? size : 0);
  } catch (...) {
    records.exception = std::current_exception();
  }
}

void on_record(int, void* self) {
  auto& records = *static_cast<Records*>(self);
  if (records.exception) return;
  try {
    records.take(std::move(records.fields), records.first);
  } catch (...) {
    records.exception = std::current_exception();
  }
  records.fields.clear();
  records.first = 0;
}

struct Parser {
  csv_parser raw{};
  Parser() {
    if (csv_init(&raw, 0) != 0) throw std::bad_alloc();
  }
  ~Parser() { csv_free(&raw); }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;
};

}  // namespace

std::size_t for_each_record(std::string_view text,
                            const std::function<void(std::vector<std::string>&&, std::size_t)>& take,
                            const RecordOptions& options) {
  Parser parser;
  csv_set_delim(&parser.raw, static_cast<unsigned char>(options.separator));
  Records records{take};
  // libcsv does not count lines, so we pass it one line at a time.
  while (!text.empty() && !records.exception) {
    const std::size_t end = text.find('\n');
    const std::size_t size = end == std::string_view::npos ? text.size() : end + 1;
    ++records.line;
    if (records.first == 0) {
      if (options.skip && options.skip(text.substr(0, size), records.line)) {
        text.remove_prefix(size);
        continue;
      }
      records.first = records.line;
    }
    if (csv_parse(&parser.raw, text.data(), size, on_field, on_record, &records) != size && !records.exception)
      throw std::bad_alloc();
    if (records.fields.empty() && parser.raw.quoted == 0) records.first = 0;  // a blank line
    text.remove_prefix(size);
  }
  csv_set_opts(&parser.raw, CSV_STRICT | CSV_STRICT_FINI);  // report a quote that is still open at the end
  const bool open_quote = !records.exception && csv_fini(&parser.raw, on_field, on_record, &records) != 0;
  if (records.exception) std::rethrow_exception(records.exception);
  return open_quote ? records.first : 0;
}

}  // namespace slipfront
