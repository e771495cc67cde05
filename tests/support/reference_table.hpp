#pragma once

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "folders.hpp"

/// One row of a table in tests/reference: column name -> text.
class ReferenceRow {
 public:
  explicit ReferenceRow(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}
  double operator[](const std::string& column) const { return std::strtod(text(column).c_str(), nullptr); }
  const std::string& text(const std::string& column) const { return cells_.at(column); }

 private:
  std::map<std::string, std::string> cells_;
};

inline std::vector<ReferenceRow> reference_table(const std::string& name) {
  std::ifstream file(std::string(reference_folder) + "/" + name);
  if (!file) throw std::runtime_error("no reference table " + name);
  const auto split = [](const std::string& line) {
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
  };
  std::string line;
  std::getline(file, line);
  const auto head = split(line);
  std::vector<ReferenceRow> rows;
  while (std::getline(file, line)) {
    const auto cells = split(line);
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < head.size(); ++i) row[head[i]] = cells.at(i);
    rows.emplace_back(std::move(row));
  }
  if (rows.empty()) throw std::runtime_error("empty reference table " + name);
  return rows;
}
