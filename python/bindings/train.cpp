#include "slipfront/theory/train.hpp"

#include <array>
#include <cmath>
#include <string>

#include "columns.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/theory/rupture/riemann.hpp"
#include "slipfront/theory/rupture/riemann_trains.hpp"

namespace {

using namespace slipfront;

State state(double phi, double psi) {
  if (!std::isfinite(phi))
    throw InputError({.key = "phi", .value = digits(phi), .problem = "not finite", .allowed = "a number"});
  if (!std::isfinite(psi) || psi < 0)
    throw InputError({.key = "psi", .value = digits(psi), .problem = "out of range", .allowed = "psi >= 0"});
  return {phi, psi};
}

constexpr std::array<Description, 10> averages_described = {{
    {"k", "density of dislocations and stress Sigma, <sigma>", "mu A / pi", "Eq. 5"},
    {"W", "slip velocity <w> = U k", "c A / pi", "Eq. 5"},
    {"sigma2", "<sigma^2>", "(mu A / pi)^2", "Eq. 5"},
    {"sigma3", "<sigma^3>", "(mu A / pi)^3", "Eq. 5"},
    {"one_minus_cos", "<1 - cos u>", "", "Eq. 6"},
    {"P", "momentum density U <sigma^2>, also the energy flux", "", "Eq. 6"},
    {"Q", "momentum flux", "", "Eq. 6"},
    {"H", "energy density", "", "Eq. 6"},
    {"I", "wave action density P / k", "", "Eqs. 6-7"},
    {"J", "wave action flux", "", "Eqs. 6-7"},
}};

py::list averages(const Numbers& phi, const Numbers& psi, const Numbers& contact) {
  const double *f = phi.data(), *s = psi.data(), *c = contact.data();
  return columns<10>(phi.size(), [=](py::ssize_t i) {
    if (!(c[i] > 0) || !std::isfinite(c[i]))
      throw InputError({.key = "contact", .value = digits(c[i]), .problem = "out of range", .allowed = "> 0"});
    const train::Averages a = train::averages(state(f[i], s[i]), c[i]);
    return std::array{a.k, a.W, a.sigma2, a.sigma3, a.one_minus_cos, a.P, a.Q, a.H, a.I, a.J};
  });
}

constexpr std::array<Description, 3> fields_described = {{
    {"u", "slip; falls by 2 pi at each dislocation", "b / (2 pi)", "Eq. 4"},
    {"sigma", "stress -u_x", "mu A / pi", "Eq. 4"},
    {"w", "slip velocity u_t = U sigma", "c A / pi", "Eq. 4"},
}};

py::list fields(const Numbers& phi, const Numbers& psi, const Numbers& xi) {
  const double *f = phi.data(), *s = psi.data(), *x = xi.data();
  return columns<3>(phi.size(), [=](py::ssize_t i) {
    if (!std::isfinite(x[i]))
      throw InputError({.key = "xi", .value = digits(x[i]), .problem = "not finite", .allowed = "a number"});
    const train::Fields at = train::fields(state(f[i], s[i]), x[i]);
    return std::array{at.u, at.sigma, at.w};
  });
}

constexpr std::array<Description, 4> jacobi_described = {{
    {"am", "amplitude am(z)", "", "Eq. 4"},
    {"sn", "sn(z)", "", "Eq. 4"},
    {"cn", "cn(z)", "", "Eq. 4"},
    {"dn", "dn(z)", "", "Eq. 4"},
}};

py::list jacobi(const Numbers& z, const Numbers& psi) {
  const double *at = z.data(), *s = psi.data();
  return columns<4>(z.size(), [=](py::ssize_t i) {
    if (!std::isfinite(at[i]))
      throw InputError({.key = "z", .value = digits(at[i]), .problem = "not finite", .allowed = "a number"});
    const elliptic::Jacobi j = elliptic::jacobi(at[i], elliptic::at_psi(s[i]));
    return std::array{j.am, j.sn, j.cn, j.dn};
  });
}

py::list spacing(const Numbers& phi, const Numbers& psi) {
  const double *f = phi.data(), *s = psi.data();
  return columns<1>(phi.size(), [=](py::ssize_t i) { return std::array{train::spacing(state(f[i], s[i]))}; });
}

State at_rest(double stress, const char* key) {
  if (stress != 0 && !(stress >= train::smallest_stress && stress <= scenario::largest_stress))
    throw InputError({.key = key, .value = digits(stress), .problem = "out of range", .allowed = "0 or 0.0045 to 1e6"});
  return train::at_rest(stress);
}

py::list psi_at_rest(const Numbers& stress) {
  const double* k = stress.data();
  return columns<1>(stress.size(), [=](py::ssize_t i) { return std::array{at_rest(k[i], "stress").psi}; });
}

py::list stress_at_rest(const Numbers& psi) {
  const double* s = psi.data();
  return columns<1>(psi.size(), [=](py::ssize_t i) { return std::array{train::stress_at_rest(s[i])}; });
}

/// The solution at each x/t, one array for each of profile_quantities(), in their order.
py::list profile(const rupture::RiemannSolution& solution, const Numbers& x_over_t) {
  const double* x = x_over_t.data();
  return columns<4>(x_over_t.size(), [&, x](py::ssize_t i) {
    if (!std::isfinite(x[i]))
      throw InputError({.key = "x_over_t", .value = digits(x[i]), .problem = "not finite", .allowed = "a number"});
    const rupture::ProfilePoint point = rupture::profile_point(solution, x[i]);
    std::array<double, 4> row{};
    for (std::size_t q = 0; q < row.size(); ++q) row.at(q) = point.*rupture::profile_quantities()[q].value;
    return row;
  });
}

py::tuple wave(const rupture::Wave& wave) {
  return py::make_tuple(std::string(rupture::name_of(wave.kind)), wave.outer, wave.inner);
}

/// The waves with shocks between two trains: edges, both waves, the state between them, and a function of x/t.
py::tuple riemann(double left_stress, double left_velocity, double right_stress, double right_velocity) {
  const rupture::RiemannSolution solution =
      rupture::solve_riemann(rupture::moving_train(left_stress, left_velocity, "left"),
                             rupture::moving_train(right_stress, right_velocity, "right"));
  const rupture::Edges edges = rupture::edges_of(solution);
  const rupture::ProfilePoint point = rupture::profile_point(solution.star);
  py::list star;
  for (const auto& quantity : rupture::profile_quantities()) star.append(point.*quantity.value);
  return py::make_tuple(py::make_tuple(edges.left, edges.right), wave(solution.left_wave), wave(solution.right_wave),
                        star, py::cpp_function([solution](const Numbers& x) { return profile(solution, x); }));
}

constexpr std::array<Description, 6> shares_described = {{
    {"slip", "slip since t = 0 over t", "c A / pi", ""},
    {"trains", "number of trains at one position", "", ""},
    {"Sigma_1", "stress of the slower train", "mu A / pi", ""},
    {"W_1", "slip velocity of the slower train", "c A / pi", ""},
    {"Sigma_2", "stress of the faster train", "mu A / pi", ""},
    {"W_2", "slip velocity of the faster train", "c A / pi", ""},
}};

/// The exact solution at each x/t: profile_quantities(), then shares_described, which are NaN for a train that is
/// absent.
py::list profile_of_trains(const rupture::TrainsSolution& solution, const Numbers& x_over_t) {
  const double* x = x_over_t.data();
  return columns<10>(x_over_t.size(), [&, x](py::ssize_t i) {
    if (!std::isfinite(x[i]))
      throw InputError({.key = "x_over_t", .value = digits(x[i]), .problem = "not finite", .allowed = "a number"});
    const rupture::TrainsPoint point = rupture::profile_point(solution, x[i]);
    std::array<double, 10> row{};
    row.fill(std::nan(""));
    for (std::size_t q = 0; q < 4; ++q) row.at(q) = point.all.*rupture::profile_quantities()[q].value;
    row[4] = point.slip;
    row[5] = static_cast<double>(point.trains.size());
    for (std::size_t train = 0; train < point.trains.size(); ++train) {
      row.at(6 + 2 * train) = point.trains[train].Sigma;
      row.at(7 + 2 * train) = point.trains[train].W;
    }
    return row;
  });
}

/// The exact Riemann problem between two trains: as riemann(), and the waves from left to right.
py::tuple riemann_trains(double left_stress, double left_velocity, double right_stress, double right_velocity) {
  const rupture::TrainsSolution solution =
      rupture::solve_trains(rupture::moving_train(left_stress, left_velocity, "left"),
                            rupture::moving_train(right_stress, right_velocity, "right"));
  const rupture::Edges edges = rupture::edges_of(solution);
  const rupture::TrainsPoint point = rupture::profile_point(solution.star);
  py::list star, waves;
  for (const auto& quantity : rupture::profile_quantities()) star.append(point.all.*quantity.value);
  for (const rupture::Region& region : solution.regions)
    waves.append(py::dict(py::arg("kind") = std::string(rupture::name_of(region.kind)), py::arg("from") = region.from,
                          py::arg("to") = region.to, py::arg("trains") = region.trains));
  return py::make_tuple(py::make_tuple(edges.left, edges.right), wave(solution.left_wave), wave(solution.right_wave),
                        star, py::cpp_function([solution](const Numbers& x) { return profile_of_trains(solution, x); }),
                        waves);
}

/// The speed of each edge of the bands between these rising edges.
py::array_t<double> edge_speeds(const Numbers& edges) {
  const double* r = edges.data();
  const std::vector<double> speeds =
      rupture::edge_speeds(rupture::bands_of_edges({r, static_cast<std::size_t>(edges.size())}));
  return py::array_t<double>(static_cast<py::ssize_t>(speeds.size()), speeds.data());
}

}  // namespace

void bind_train(py::module_& m) {
  m.def("averages", averages);
  m.def("fields", fields);
  m.def("jacobi", jacobi);
  m.def("spacing", spacing);
  m.def("psi_at_rest", psi_at_rest);
  m.def("stress_at_rest", stress_at_rest);
  m.def("riemann", riemann);
  m.def("edge_speeds", edge_speeds);
  m.def("riemann_trains", riemann_trains);
  m.attr("averages_described") = all(averages_described);
  m.attr("fields_described") = all(fields_described);
  m.attr("jacobi_described") = all(jacobi_described);
  py::list about;
  for (const auto& quantity : rupture::profile_quantities()) about.append(described(quantity.about));
  m.attr("profile_described") = about;
  m.attr("profile_of_trains_described") = about + all(shares_described);
}
