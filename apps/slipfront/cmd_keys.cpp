#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "batch.hpp"
#include "commands.hpp"
#include "json.hpp"
#include "slipfront/error.hpp"
#include "slipfront/scenario/keys.hpp"
#include "terminal_table.hpp"
#include "text/characters.hpp"

namespace {

using slipfront::scenario::Key;

struct KeysArguments {
  std::string table;
  bool json = false, wide = false;
};

Json json_of_key(const Key& key) {
  Json row;
  row["table"] = key.table;
  row["key"] = key.name;
  row["type"] = name_of(key.type);
  row["unit"] = key.unit;
  row["allowed"] = key.allowed();
  row["default"] = key.otherwise;
  row["meaning"] = key.meaning;
  row["laws"] = key.laws;
  return row;
}

void print(const Key& key) {
  std::string facts(name_of(key.type));
  if (const std::string allowed = key.allowed(); !allowed.empty()) facts += ": " + allowed;
  if (!key.unit.empty() && key.unit != "1") facts += fmt::format(", in {}", key.unit);
  if (!key.otherwise.empty()) facts += fmt::format("; default: {}", key.otherwise);
  if (!key.laws.empty()) facts += fmt::format("; laws: {}", fmt::join(key.laws, ", "));
  for (const auto& [name, words] : {std::pair<std::string_view, std::string_view>{key.name, key.meaning}, {"", facts}})
    put(fitted(fmt::format("  {:<20} {}", name, words), 2 + 20 + 1));
}

std::vector<Key> chosen(const std::string& table) {
  std::vector<Key> keys;
  std::vector<std::string_view> tables;
  for (const Key& key : slipfront::scenario::keys()) {
    if (table.empty() || key.table == table) keys.push_back(key);
    if (!key.table.empty() && (tables.empty() || tables.back() != key.table)) tables.push_back(key.table);
  }
  if (keys.empty())
    throw slipfront::InputError({.file = "command line",
                                 .key = "TABLE",
                                 .value = table,
                                 .problem = "unknown table",
                                 .allowed = slipfront::nearest_or_all(table, tables)});
  return keys;
}

int run_keys(const KeysArguments& arguments) {
  if (arguments.wide) print_whole_lines();
  const std::vector<Key> keys = chosen(arguments.table);
  if (arguments.json) {
    Json all;
    for (const Key& key : keys) all["keys"].push_back(json_of_key(key));
    put(text_of(all) + "\n");
    return exit_done;
  }
  std::string_view table;
  for (const Key& key : keys) {
    if (key.table != table) put(fmt::format("\n[{}]\n", key.table));
    table = key.table;
    print(key);
  }
  return exit_done;
}

}  // namespace

Runner add_keys(CommandLine& program) {
  auto arguments = std::make_shared<KeysArguments>();
  CommandLine command = program.command("keys", "All keys of a scenario file, with types, units, ranges and defaults",
                                        {"slipfront keys pulse", "slipfront keys --json"});
  command.option("TABLE", "", arguments->table, "A table of the scenario, such as pulse (default: all)");
  command.flag("--json", arguments->json, "One JSON object on stdout, nothing else");
  add_wide(command, arguments->wide);
  return [arguments] { return run_keys(*arguments); };
}
