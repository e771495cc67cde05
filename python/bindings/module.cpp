#include <string>

#include "bindings.hpp"
#include "runs/record/run_file.hpp"

PYBIND11_MODULE(_slipfront, m) {
  m.attr("__version__") = SLIPFRONT_VERSION;
  m.def("reference_of", [](const std::string& reference) {
    return slipfront::record::reference_of({{}, {}, {}, reference});
  });
  bind_errors(m);
  bind_relations(m);
  bind_train(m);
  bind_friction_ratio(m);
  bind_medium(m);
  bind_measured(m);
  bind_runs(m);
  bind_compare(m);
  bind_event(m);
  bind_observations(m);
  bind_sweep(m);
  bind_keys(m);
  bind_files(m);
}
