#include "slipfront/rupture/relations.hpp"

#include <array>
#include <string>

#include "bindings.hpp"
#include "foundation/parallel.hpp"
#include "slipfront/error.hpp"

namespace {

using namespace slipfront;

struct Given {
  const char* name;
  rupture::Relations (*solve)(double);
};
constexpr std::array<Given, 3> ways = {{{"stress", rupture::from_stress},
                                        {"rupture_velocity", rupture::from_rupture_velocity},
                                        {"slip_velocity", rupture::from_slip_velocity}}};

/// One array for each of relations_quantities(), in their order.
py::list relations(const std::string& given, const Numbers& values, int threads) {
  const Given* way = nullptr;
  for (const Given& g : ways)
    if (given == g.name) way = &g;
  const auto count = static_cast<std::size_t>(values.size());
  const double* in = values.data();
  const auto quantities = rupture::relations_quantities();
  py::list columns;
  std::array<double*, 9> out{};
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    py::array_t<double> column(static_cast<py::ssize_t>(count));
    out.at(q) = column.mutable_data();
    columns.append(column);
  }
  const py::gil_scoped_release others_may_run;
  for_each_parallel(count, threads, [&](std::size_t i) {
    try {
      const rupture::Relations r = way->solve(in[i]);
      for (std::size_t q = 0; q < quantities.size(); ++q) out[q][i] = r.*quantities[q].value;
    } catch (const InputError& error) {
      if (count == 1) throw;
      Complaint complaint = error.complaint();  // which of them
      complaint.key.append("[").append(std::to_string(i)).append("]");
      throw InputError(complaint);
    }
  });
  return columns;
}

}  // namespace

void bind_relations(py::module_& m) {
  m.def("relations", relations);
  py::list about;
  for (const auto& q : rupture::relations_quantities()) about.append(described(q.about));
  m.attr("relations_quantities") = about;
}
