#include "slipfront/scenario/files.hpp"

#include <filesystem>

#include "scenario/text/document.hpp"

namespace slipfront::scenario {

std::vector<std::string> files_of(const Scenario& scenario) {
  std::vector<std::string> files = {scenario.file};
  const std::filesystem::path folder = std::filesystem::path(scenario.file).parent_path();
  const Document document = read_document(scenario.text, scenario.file, {});
  for (const auto& [name, table] : document.tables)
    if (const auto file = table.values.find("file"); file != table.values.end())
      files.push_back((folder / file->second.text).string());
  return files;
}

}  // namespace slipfront::scenario
