#include "scenario/plane/radial.hpp"

#include <cmath>
#include <memory>

#include "foundation/text/digits.hpp"
#include "scenario/profile/monotone.hpp"
#include "scenario/profile/table.hpp"

namespace slipfront::scenario {

std::function<double(double, double)> read_radial(const Section& section, const TableReader& tables, double ratio) {
  const Column radius{"r", {.least = 0, .most = farthest}, section.in_file(ModelUnit::position)};
  const Column slip{"slip", {.least = 0}, section.in_file(ModelUnit::slip)};
  const auto rows = read_rows(section, tables, radius, slip);
  if (rows.back().second != 0)
    throw section.refuse("file", "its last row has the slip " + shortest(rows.back().second),
                         "0 in the last row, where the rupture ends");
  const auto curve = std::make_shared<const MonotoneCurve>(rows);
  return [curve, ratio](double x, double y) {
    const double r = std::hypot(x, ratio * y);
    if (r >= curve->last()) return 0.0;
    return (*curve)(std::fmax(r, curve->first()));
  };
}

}  // namespace slipfront::scenario
