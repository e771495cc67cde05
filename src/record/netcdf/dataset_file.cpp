#include "record/netcdf/dataset_file.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <stdexcept>

#include "record/netcdf/netcdf.hpp"

namespace slipfront::record {
namespace {

using netcdf::Writer;

void add_attributes(Writer& file, int variable, const Attributes& attributes) {
  for (const auto& [name, value] : attributes) {
    if (const auto* text = std::get_if<std::string>(&value))
      file.attribute(variable, name, clean_text(*text, text->size()));
    else if (const auto* whole = std::get_if<std::int64_t>(&value))
      file.attribute(variable, name, *whole);
    else
      file.attribute(variable, name, std::get<double>(value));
  }
}

/// The id of a variable that is defined but not written.
int define(Writer& file, const DatasetVariable& variable, const std::map<std::string, int>& dimensions) {
  std::vector<int> ids;
  for (const std::string& name : variable.dimensions) ids.push_back(dimensions.at(name));
  const std::size_t kind = variable.values.index();
  const int id = kind == 0   ? file.reals(variable.name, ids)
                 : kind == 1 ? file.integers(variable.name, ids)
                 : kind == 2 ? file.small_integers(variable.name, ids)
                             : file.strings(variable.name, ids);
  add_attributes(file, id, variable.attributes);
  return id;
}

void check(const Dataset& dataset) {
  const std::map<std::string, std::size_t> sizes(dataset.dimensions.begin(), dataset.dimensions.end());
  for (const DatasetVariable& variable : dataset.variables) {
    std::size_t wanted = 1;
    for (const std::string& name : variable.dimensions) {
      const auto size = sizes.find(name);
      if (size == sizes.end()) throw std::invalid_argument("write_dataset: " + name + " is no dimension");
      wanted *= size->second;
    }
    if (std::visit([](const auto& values) { return values.size(); }, variable.values) != wanted)
      throw std::invalid_argument("write_dataset: " + variable.name + " has not as many values as its dimensions");
  }
}

}  // namespace

void write_dataset(const std::string& path, const Dataset& dataset) {
  check(dataset);
  write_netcdf(path, 0, [&](Writer& file) {
    add_attributes(file, Writer::global, dataset.attributes);
    std::map<std::string, int> dimensions;
    for (const auto& [name, size] : dataset.dimensions) dimensions[name] = file.dimension(name, size);
    std::vector<int> ids;
    for (const DatasetVariable& variable : dataset.variables) ids.push_back(define(file, variable, dimensions));
    file.end_definitions();
    for (std::size_t i = 0; i < ids.size(); ++i)
      std::visit(
          [&](const auto& values) {
            if (!values.empty()) file.write_all(ids[i], values);  // a dimension of size 0 is an unlimited one
          },
          dataset.variables[i].values);
  });
}

}  // namespace slipfront::record
