#include "slipfront/theory/rupture/relations.hpp"

#include <array>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/rupture/riemann_trains.hpp"
#include "system/parallel.hpp"

namespace {

using namespace slipfront;

struct Given {
  const char* name;
  rupture::Relations (*solve)(double);
};
constexpr std::array<Given, 3> ways = {{{"stress", rupture::from_stress},
                                        {"rupture_velocity", rupture::from_rupture_velocity},
                                        {"slip_velocity", rupture::from_slip_velocity}}};

/// Calls solve(i), and returns one array for each of `quantities`, in their order.
template <class Solve>
py::list one_column_each(const auto& quantities, std::size_t count, int threads, const Solve& solve) {
  py::list columns;
  std::vector<double*> out;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    py::array_t<double> column(static_cast<py::ssize_t>(count));
    out.push_back(column.mutable_data());
    columns.append(column);
  }
  const py::gil_scoped_release others_may_run;
  for_each_parallel(count, threads, [&](std::size_t i) {
    try {
      const auto row = solve(i);
      for (std::size_t q = 0; q < quantities.size(); ++q) out[q][i] = row.*quantities[q].value;
    } catch (const InputError& error) {
      if (count == 1) throw;
      Complaint complaint = error.complaint();  // which of them
      complaint.key.append("[").append(std::to_string(i)).append("]");
      throw InputError(complaint);
    }
  });
  return columns;
}

py::list relations(const std::string& given, const Numbers& values, int threads) {
  const Given* way = nullptr;
  for (const Given& g : ways)
    if (given == g.name) way = &g;
  const double* in = values.data();
  return one_column_each(rupture::relations_quantities(), static_cast<std::size_t>(values.size()), threads,
                         [&](std::size_t i) { return way->solve(in[i]); });
}

py::list step_relations(const Numbers& stress, const Numbers& stress_right, int threads) {
  const double *left = stress.data(), *right = stress_right.data();
  return one_column_each(rupture::step_quantities(), static_cast<std::size_t>(stress.size()), threads,
                         [&](std::size_t i) { return rupture::step_relations(left[i], right[i]); });
}

}  // namespace

void bind_relations(py::module_& m) {
  m.def("relations", relations);
  py::list about;
  for (const auto& q : rupture::relations_quantities()) about.append(described(q.about));
  m.attr("relations_quantities") = about;
  m.def("step_relations", step_relations);
  py::list of_steps;
  for (const auto& q : rupture::step_quantities()) of_steps.append(described(q.about));
  m.attr("step_quantities") = of_steps;
}
