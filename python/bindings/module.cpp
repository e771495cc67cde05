#include "bindings.hpp"

PYBIND11_MODULE(_slipfront, m) {
  m.attr("__version__") = SLIPFRONT_VERSION;
  bind_errors(m);
  bind_relations(m);
}
