#include "finite_fault/fault_columns.hpp"

#include <algorithm>
#include <cmath>

namespace slipfront::finite_fault {
namespace {

/// Rupture times of subfaults with a smaller fraction of the largest slip are ignored. Published tables give times for
/// all subfaults, but times of subfaults that hardly slip are arbitrary.
constexpr double least_share = 0.05;

bool timed(const LocalState& s, double least_slip) { return s.subfault.rupture_time && s.subfault.slip > least_slip; }

double time_of(const LocalState& s) { return *s.subfault.rupture_time; }

/// Makes one column from its subfaults, [from, to). Its time is NaN if none of them has a time that counts.
FaultColumn column_of(const std::vector<LocalState>& states, std::size_t from, std::size_t to, double origin,
                      double begin, double least_slip) {
  const double n = static_cast<double>(to - from);
  FaultColumn c{0, 0, NAN};
  for (std::size_t i = from; i < to; ++i) {
    c.x += (states[i].along_strike - origin) / n;
    c.slip += std::fmax(0, states[i].subfault.slip) / n;
    if (timed(states[i], least_slip)) c.rupture_time = std::fmin(c.rupture_time, time_of(states[i]) - begin);
  }
  return c;
}

/// The subfault that slipped first, or null if none has a time.
const LocalState* first_of(const std::vector<LocalState>& states, double least_slip) {
  const LocalState* first = nullptr;
  for (const LocalState& s : states)
    if (timed(s, least_slip) && (!first || time_of(s) < time_of(*first))) first = &s;
  return first;
}

/// The subfaults of a segment, sorted along strike.
std::vector<LocalState> segment_of(const std::vector<LocalState>& states, std::size_t number) {
  std::vector<LocalState> segment;
  for (const LocalState& s : states)
    if (s.subfault.segment == number) segment.push_back(s);
  std::sort(segment.begin(), segment.end(),
            [](const LocalState& a, const LocalState& b) { return a.along_strike < b.along_strike; });
  return segment;
}

/// Divides a segment into columns. Subfaults of one column have the same position along strike, up to rounding. Columns
/// are apart by the length of a subfault, which is at most `widest`. Returns the reason if the segment cannot be
/// divided, and otherwise an empty text.
std::string divide(const std::vector<LocalState>& segment, double origin, double begin, double least_slip,
                   double widest, std::vector<FaultColumn>& columns) {
  double broadest = 0;
  bool alike = true;
  std::size_t rows = 0;
  for (std::size_t from = 0, to = 0; from < segment.size(); from = to) {
    while (++to < segment.size() && segment[to].along_strike - segment[to - 1].along_strike <= widest / 2) {
    }
    if (columns.empty()) rows = to;
    alike = alike && to - from == rows;
    broadest = std::fmax(broadest, segment[to - 1].along_strike - segment[from].along_strike);
    columns.push_back(column_of(segment, from, to, origin, begin, least_slip));
    // Files give positions to a metre. A column this close to the hypocentre is at the hypocentre, and belongs to both
    // sides.
    if (std::fabs(columns.back().x) < 0.01 * widest) columns.back().x = 0;
  }
  if (!alike || broadest > widest / 2) return "the subfaults do not form columns along strike";
  if (columns.size() < 3) return std::to_string(columns.size()) + " columns along strike, but at least 3 are needed";
  return {};
}

}  // namespace

FaultColumns columns_of(const std::vector<LocalState>& states) {
  if (states.empty()) return {{}, 0, "the file gives no positions of subfaults"};
  double least_slip = 0;
  for (const LocalState& s : states) least_slip = std::fmax(least_slip, least_share * s.subfault.slip);
  const LocalState* first = first_of(states, least_slip);
  if (!first) return {{}, 0, "the file gives no rupture times (TRUP)"};
  const double begin = time_of(*first);

  const std::vector<LocalState> segment = segment_of(states, first->subfault.segment);
  FaultColumns out;
  double origin = 0, beginning = 0, latest = 0, widest = 0;
  for (std::size_t i = 0; i < segment.size(); ++i) {
    const LocalState& s = segment[i];
    if (i > 0) widest = std::fmax(widest, s.along_strike - segment[i - 1].along_strike);
    if (!timed(s, least_slip)) continue;
    if (time_of(s) <= begin) origin += s.along_strike, ++beginning;
    latest = std::fmax(latest, time_of(s) - begin);
    out.end = std::fmax(out.end, time_of(s) - begin + s.subfault.rise_time.value_or(0));
  }
  if (!(latest > 0)) return {{}, 0, "all rupture times (TRUP) are equal"};
  origin /= beginning;

  const std::string reason = divide(segment, origin, begin, least_slip, widest, out.columns);
  if (!reason.empty()) return {{}, 0, reason};
  return out;
}

}  // namespace slipfront::finite_fault
