#include <string>

#include "columns.hpp"
#include "slipfront/friction/ratio/table.hpp"

namespace {

using namespace slipfront;

constexpr std::array<Description, 4> friction_ratio_described = {{
    {"ratio", "slip velocity with viscous friction over the frictionless one at x = 0", "", "Fig. 10"},
    {"by_damping_number", "derivative of the ratio by the damping number", "", "Fig. 10"},
    {"by_stress", "derivative of the ratio by the stress", "pi / (mu A)", "Fig. 10"},
    {"uncertainty", "largest relative error of the ratio", "", "Fig. 10"},
}};

py::list friction_ratio_of(const Numbers& stress, const Numbers& damping, const std::string& measure,
                           const std::string& closure_name) {
  const friction::Closure closure = friction::closure_named(closure_name);
  const friction_ratio::SlipVelocityKind which = friction_ratio::measure_named(measure, "measure");
  const double *s = stress.data(), *g = damping.data();
  return columns<4>(stress.size(), [=](py::ssize_t i) {
    const friction_ratio::Ratio r = friction_ratio::evaluate(which, closure, s[i], g[i]);
    return std::array{r.value, r.by_damping, r.by_stress, friction_ratio::uncertainty(closure, g[i])};
  });
}

constexpr std::array<Description, 2> damping_number_described = {{
    {"damping_number", "damping number C T at which friction leaves this ratio", "", "Fig. 10"},
    {"damping_number_error", "its largest error, from that of the table", "", "Fig. 10"},
}};

py::list damping_number_of(const Numbers& stress, const Numbers& ratio, const std::string& measure,
                           const std::string& closure_name) {
  const friction::Closure closure = friction::closure_named(closure_name);
  const friction_ratio::SlipVelocityKind which = friction_ratio::measure_named(measure, "measure");
  const double *s = stress.data(), *r = ratio.data();
  return columns<2>(stress.size(), [=](py::ssize_t i) {
    const friction_ratio::Reading reading = friction_ratio::damping_number(which, closure, s[i], r[i]);
    return std::array{reading.damping_number, reading.error};
  });
}

/// The observed front over |V-|, for arrays of one length.
py::array_t<double> front_ratio_of(const Numbers& stress, const Numbers& damping, double threshold,
                                   const std::string& closure_name) {
  const friction_ratio::FrontCurve curve(friction::closure_named(closure_name), threshold);
  py::array_t<double> ratio(stress.size());
  for (py::ssize_t i = 0; i < stress.size(); ++i)
    ratio.mutable_data()[i] = curve(stress.data()[i], damping.data()[i]).value;
  return ratio;
}

/// The static stress drop at x = 0 over Sigma-, for arrays of one length.
py::array_t<double> stress_drop_share_of(const Numbers& stress, const Numbers& damping,
                                         const std::string& closure_name) {
  const friction::Closure closure = friction::closure_named(closure_name);
  py::array_t<double> share(stress.size());
  for (py::ssize_t i = 0; i < stress.size(); ++i)
    share.mutable_data()[i] =
        friction_ratio::stress_drop_share(friction_ratio::Drop::origin, closure, stress.data()[i], damping.data()[i])
            .value;
  return share;
}

}  // namespace

void bind_friction_ratio(py::module_& m) {
  m.def("friction_ratio", friction_ratio_of);
  m.attr("friction_ratio_described") = all(friction_ratio_described);
  m.def("damping_number", damping_number_of);
  m.def("front_ratio", front_ratio_of);
  m.def("stress_drop_share", stress_drop_share_of);
  m.attr("damping_number_described") = all(damping_number_described);
}
