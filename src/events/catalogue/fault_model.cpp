#include "events/catalogue/fault_model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "events/catalogue/format.hpp"
#include "events/catalogue/fsp/fsp.hpp"
#include "events/catalogue/subfaults/subfaults.hpp"
#include "math/digits.hpp"

namespace slipfront::catalogue {
namespace {

constexpr const subfaults::FaultFormat* fault_formats[] = {&subfaults::srf_format, &subfaults::param_format,
                                                           &subfaults::rupt_format, &subfaults::geojson_format,
                                                           &subfaults::csv_format};

const subfaults::FaultFormat* format_of_subfaults(std::string_view text) {
  const auto at = std::find_if(std::begin(fault_formats), std::end(fault_formats),
                               [text](const auto* format) { return format->looks_like(text); });
  return at == std::end(fault_formats) ? nullptr : *at;
}

}  // namespace

bool is_fault_model(std::string_view text) { return first_character(text) == '%' || format_of_subfaults(text); }

FaultModel read_fault_model(std::string_view text, const std::string& file) {
  const subfaults::FaultFormat* format = format_of_subfaults(text);
  return format ? subfaults::model_of(format->read(text, file)) : fsp::read_model(text, file);
}

void give_slip(Observation& o, double slip, std::optional<double> rise_time) {
  if (rise_time) o.rise_time = MeasuredValue{*rise_time, *rise_time};
  if (!(slip > 0)) {
    o.warnings.push_back("mean slip = " + shortest(slip) + " m is not positive: not given");
    return;
  }
  o.slip = MeasuredValue{slip, slip};
  const double velocity = rise_time ? slip / *rise_time : 0;
  if (!rise_time)
    o.warnings.push_back("no rise time: slip velocity not given");
  else if (std::isfinite(velocity) && velocity > 0)
    o.slip_velocity_m_s = MeasuredValue{velocity, velocity};
  else
    o.warnings.push_back("slip / rise time is out of range: slip velocity not given");
}

const Format fault_format{
    .ending = ".fsp",
    .looks_like = is_fault_model,
    .read = [](std::string_view text, const std::string& file, const Sink& sink, const TableOptions&) {
      sink({read_fault_model(text, file).observation, {}});
      return TableNotes{};
    }};

}  // namespace slipfront::catalogue
