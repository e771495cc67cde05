#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "batch.hpp"
#include "commands.hpp"
#include "json.hpp"
#include "slipfront/error.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "system/files/whole_file.hpp"
#include "terminal_table.hpp"

namespace {

using slipfront::catalogue::ColumnDescription;
using slipfront::catalogue::TableDescription;

struct ColumnsArguments {
  std::string table, column_map, output;
  bool fronts = false, json = false, wide = false;
};

Json json_of_table(const TableDescription& table) {
  Json all;
  all["file"] = table.file;
  all["header_line"] = table.header_line > 0 ? Json(table.header_line) : Json();
  all["separator"] = std::string(1, table.separator);
  all["decimal_comma"] = table.decimal_comma;
  all["columns"] = Json::array();
  for (const ColumnDescription& column : table.columns) {
    Json row;
    row["title"] = column.title;
    row["meaning"] = column.meaning;
    row["unit"] = column.unit;
    row["standard_deviations"] = column.deviations > 0 ? Json(column.deviations) : Json();
    row["reason"] = column.reason;
    row["looks_like_quantity"] = column.looks_physical;
    all["columns"].push_back(std::move(row));
  }
  all["map"] = table.map;
  return all;
}

void print_table(const TableDescription& table) {
  std::size_t width = 5;
  for (const ColumnDescription& column : table.columns)
    width = std::max(width, std::min<std::size_t>(characters(column.title), 30));
  for (const ColumnDescription& column : table.columns) {
    std::string meaning = column.meaning;
    if (!column.unit.empty()) meaning += " in " + column.unit;
    if (column.deviations > 1) meaning += fmt::format(", {} standard deviations", column.deviations);
    if (!column.reason.empty()) meaning += (meaning.empty() ? "not used: " : "; cannot be read: ") + column.reason;
    put(fitted(fmt::format("{:<{}}  {}", column.title, width, meaning), width + 2));
  }
}

int run_columns(const ColumnsArguments& a) {
  using namespace slipfront;
  if (a.wide) print_whole_lines();
  record::require_other_file(a.output, {a.table, a.column_map});
  const bool standard_input = a.table == "-";
  const std::string text = standard_input ? record::read_standard_input() : record::read_text(a.table);
  catalogue::TableOptions options{.of_fronts = a.fronts};
  if (!a.column_map.empty()) options.map = record::read_text(a.column_map), options.map_file = a.column_map;
  const TableDescription table = catalogue::describe_table(text, standard_input ? "stdin" : a.table, options);
  if (!a.output.empty()) record::write_text(a.output, table.map);
  if (a.json) {
    put(text_of(json_of_table(table)) + "\n");
    return exit_done;
  }
  print_table(table);
  if (a.output.empty()) put("\n" + table.map);
  return exit_done;
}

}  // namespace

Runner add_columns(CommandLine& program) {
  auto arguments = std::make_shared<ColumnsArguments>();
  CommandLine command =
      program.command("columns", "How the columns of a table are understood, with a map to edit",
                      {"slipfront columns cases/catalogue.csv", "slipfront columns cases/catalogue.csv -o map.toml",
                       "slipfront columns cases/synthetic-laboratory-fronts.csv --fronts"});
  command.option("FILE", "", arguments->table, "Table of events (CSV), - for stdin").required();
  command.option("--columns", "MAP.toml", arguments->column_map,
                 "A map of the columns, as of slipfront event, to check");
  command.flag("--fronts", arguments->fronts, "A table of slipfront laboratory: one front a row");
  command.option("-o,--output", "MAP.toml", arguments->output, "File to write the map to");
  command.flag("--json", arguments->json, "One JSON object on stdout, nothing else");
  add_wide(command, arguments->wide);
  return [arguments] { return run_columns(*arguments); };
}
