#include "runs/tables.hpp"

#include "events/catalogue/fault_model.hpp"
#include "events/finite_fault/on_plane.hpp"
#include "runs/fault.hpp"
#include "runs/record/netcdf/table_file.hpp"
#include "slipfront/error.hpp"
#include "system/files/whole_file.hpp"

namespace slipfront::run {

bool is_fault_model(const std::string& path) try {
  if (path.ends_with(".toml") || path.ends_with(".nc") || path == "-") return false;
  return path.ends_with(".fsp") || catalogue::is_fault_model(record::read_regular(path));
} catch (const FileError&) {  // its reader reports it, or it is a pipe, which can be read only once
  return false;
}

std::vector<std::vector<double>> read_table(const std::string& path, const std::vector<std::string>& columns) {
  const std::string text = record::read_regular(path);
  const bool is_model = path.ends_with(".fsp") || (!path.ends_with(".nc") && catalogue::is_fault_model(text));
  if (!is_model) return record::table_of(text, path, columns);
  if (columns != std::vector<std::string>{"x", "y", "slip"})
    throw InputError({.file = path,
                      .problem = "a finite-fault model has no such columns",
                      .allowed = "initial.profile = \"grid\" on a plane"});
  const catalogue::FaultModel model = catalogue::read_fault_model(text, path);
  const finite_fault::OnPlane fault =
      finite_fault::on_plane(finite_fault::finite_source(model, medium::defaults_of({}), {}));
  return finite_fault::slip_to_come(fault, margin_of(fault));
}

}  // namespace slipfront::run
