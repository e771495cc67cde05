#include "slipfront/scenario/keys.hpp"

#include <pybind11/stl.h>

#include <string>
#include <string_view>

#include "bindings.hpp"

void bind_keys(py::module_& m) {
  /// {"friction.coefficient": (type, unit)} of each key of a scenario. The unit is empty unless the key is a number.
  m.def("scenario_keys", [] {
    py::dict all;
    for (const slipfront::scenario::Key& key : slipfront::scenario::keys()) {
      const std::string name =
          key.table.empty() ? std::string(key.name) : std::string(key.table) + "." + std::string(key.name);
      all[py::str(name)] = py::make_tuple(name_of(key.type), key.unit);
    }
    return all;
  });
}
