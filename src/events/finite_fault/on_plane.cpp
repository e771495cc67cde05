#include "events/finite_fault/on_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "math/digits.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"
#include "text/characters.hpp"
#include "theory/modulation/equations.hpp"
#include "theory/rupture/inverse.hpp"

namespace slipfront::finite_fault {
namespace {

constexpr std::size_t nodes = 8000;  // some hundreds to a column

}  // namespace

double SideStress::at(double d) const {
  if (d >= distance.back()) return stress.back();
  const auto above = std::upper_bound(distance.begin(), distance.end(), std::fmax(d, 0)) - distance.begin();
  const auto i = static_cast<std::size_t>(above);
  const double share = (std::fmax(d, 0) - distance[i - 1]) / (distance[i] - distance[i - 1]);
  const double value = std::lerp(stress[i - 1], stress[i], share);
  return value < least_stress ? 0 : value;
}

HeldSide::HeldSide(SideStress stress, double end) : stress_(std::move(stress)) {
  const auto speed_at = [](const State& s) { return s.empty() ? 0 : modulation::sound(s.psi).c0; };
  // Nothing that the pulse meets may come back from the end of the grid.
  const double beyond = 1.2 * end * speed_at(train::at_rest(stress_.stress.back()));
  length_ = stress_.distance.back() + beyond;
  node_ = length_ / static_cast<double>(nodes);
  double time = 0, slowness = 0;
  for (std::size_t i = 0; i <= nodes; ++i) {
    const State s = train::at_rest(stress_.at(node_ * static_cast<double>(i)));
    const double next = s.empty() ? std::numeric_limits<double>::infinity() : 1 / speed_at(s);
    if (i > 0) time += node_ * (slowness + next) / 2;
    slowness = next;
    pressure_.push_back(modulation::pressure(s.psi));
    time_.push_back(time);
  }
}

double HeldSide::front_time(double distance) const {
  const auto i = std::min(static_cast<std::size_t>(distance / node_), nodes - 1);
  const double share = distance / node_ - static_cast<double>(i);
  if (!(share > 0)) return time_[i];
  return std::isinf(time_[i + 1]) ? time_[i + 1] : std::lerp(time_[i], time_[i + 1], share);
}

pulse::Problem HeldSide::problem() const {
  const auto stress = [side = *this](double x) { return x > 0 ? 0 : side.stress_.at(-x); };
  const auto load = [side = *this](double x, double) {
    if (x > 0 || -x >= side.length_) return 0.0;
    const double k = side.stress_.at(-x);
    if (!(k > 0)) return 0.0;
    const auto i = std::min(static_cast<std::size_t>(-x / side.node_), nodes - 1);
    return (side.pressure_[i] - side.pressure_[i + 1]) / (side.node_ * k);
  };
  return {.stress = stress,
          .forcing = load,
          .friction = {},
          .left = -length_,
          .right = 0.1 * length_,
          .corner = 0,
          .cells = 1600};
}

namespace {

const SourceSegment& segment_of_hypocentre(const FiniteSource& source) {
  for (const SourceSegment& segment : source.segments)
    if (segment.has_hypocentre) return segment;
  return source.segments.front();
}

double moment_of(const SourceSegment& segment) {
  double moment = 0;
  for (const SourcePoint& point : segment.points) moment += point.shear_modulus() * point.slip * segment.cell_area();
  return moment;
}

/// Finds the gradient of the slip, from differences between neighbours. Outside of the model the slip is 0.
void find_gradients(OnPlane& fault) {
  const auto nx = static_cast<std::ptrdiff_t>(fault.x.size()), ny = static_cast<std::ptrdiff_t>(fault.y.size());
  const auto slip = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    const bool inside = i >= 0 && i < nx && j >= 0 && j < ny;
    return inside ? fault.slip[fault.at(static_cast<std::size_t>(i), static_cast<std::size_t>(j))] : 0;
  };
  double sum = 0, weight = 0;
  for (std::ptrdiff_t j = -1; j < ny; ++j)
    for (std::ptrdiff_t i = -1; i < nx; ++i) {
      const double along = (slip(i + 1, j) - slip(i, j)) / fault.cell_length,
                   up = (slip(i, j + 1) - slip(i, j)) / fault.cell_width, size = std::hypot(along, up);
      fault.largest_gradient = std::fmax(fault.largest_gradient, size);
      sum += slip(i, j) * size;
      weight += slip(i, j);
    }
  fault.mean_gradient = sum / weight;
}

}  // namespace

OnPlane on_plane(const FiniteSource& source) {
  const SourceSegment& segment = segment_of_hypocentre(source);
  OnPlane fault;
  fault.cell_length = segment.cell_length;
  fault.cell_width = segment.cell_width;
  const double left = -segment.cell_length * static_cast<double>(segment.along_strike) / 2;
  for (std::size_t i = 0; i < segment.along_strike; ++i)
    fault.x.push_back(left + (static_cast<double>(i) + 0.5) * segment.cell_length - segment.hypocentre_along_strike);
  for (std::size_t j = segment.down_dip; j-- > 0;) {
    fault.y.push_back(segment.hypocentre_down_dip - (static_cast<double>(j) + 0.5) * segment.cell_width);
    for (std::size_t i = 0; i < segment.along_strike; ++i) {
      const SourcePoint& point = segment.points[j * segment.along_strike + i];
      fault.slip.push_back(std::fmax(point.slip, 0));
      fault.rupture_time.push_back(point.rupture_time);
      if (point.slip > 0) fault.end = std::fmax(fault.end, point.rupture_time + point.rise_time);
    }
  }
  fault.moment = moment_of(segment);
  fault.largest_slip = *std::max_element(fault.slip.begin(), fault.slip.end());
  find_gradients(fault);
  if (source.segments.size() > 1) {
    double all = 0;
    for (const SourceSegment& any : source.segments) all += moment_of(any);
    fault.note = "only the segment of the hypocentre is computed, which has " + digits(100 * fault.moment / all, 3) +
                 " % of the moment";
  }
  return fault;
}

std::vector<std::vector<double>> slip_to_come(const OnPlane& fault, double margin) {
  const auto with_margin = [margin](const std::vector<double>& centres, double cell) {
    std::vector<double> all = {centres.front() - cell / 2 - margin, centres.front() - cell};
    all.insert(all.end(), centres.begin(), centres.end());
    all.push_back(centres.back() + cell);
    all.push_back(centres.back() + cell / 2 + margin);
    return all;
  };
  const std::vector<double> x = with_margin(fault.x, fault.cell_length), y = with_margin(fault.y, fault.cell_width);
  std::vector<std::vector<double>> rows;
  rows.reserve(x.size() * y.size());
  for (std::size_t j = 0; j < y.size(); ++j)
    for (std::size_t i = 0; i < x.size(); ++i) {
      const bool inside = i >= 2 && i < x.size() - 2 && j >= 2 && j < y.size() - 2;
      rows.push_back({x[i], y[j], fault.largest_slip - (inside ? fault.slip[fault.at(i - 2, j - 2)] : 0)});
    }
  return rows;
}

std::vector<double> moment_rate(const FiniteSource& source, double interval, std::size_t count) {
  std::vector<double> rate(count, 0.0);
  for (const SourcePoint& point : segment_of_hypocentre(source).points) {
    const double per = point.shear_modulus() * segment_of_hypocentre(source).cell_area();
    double time = point.rupture_time + source.time_step / 2;
    for (const double slip_rate : slip_rates(source, point)) {
      const double row = time / interval;
      if (row >= 0 && row < static_cast<double>(count))
        rate[static_cast<std::size_t>(row)] += per * slip_rate * source.time_step / interval;
      time += source.time_step;
    }
  }
  return rate;
}

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

using catalogue::Entry;
using catalogue::Observation;
using inference::Estimate;
using inference::estimate;

namespace {

/// Groups of digits in a date such as 2004-09-28 or 09/28/2004, up to a blank or a T, after which comes the time of
/// day.
std::vector<std::string> digit_groups(std::string_view date) {
  std::vector<std::string> groups(1);
  for (const char c : date.substr(0, date.find_first_of(" T"))) {
    if (is_digit(c))
      groups.back() += c;
    else if (!groups.back().empty())
      groups.emplace_back();
  }
  if (groups.back().empty()) groups.pop_back();
  return groups;
}

std::string two_digits(const std::string& number) { return number.size() == 1 ? "0" + number : number; }

/// The date as "2004-09-28", or as "2004" if only the year is known. It is empty if the text is neither.
std::string day_of(std::string_view date) {
  std::vector<std::string> g = digit_groups(date);
  if (g.size() == 1 && g[0].size() == 4) return g[0];
  if (g.size() != 3) return {};
  if (g[2].size() == 4) g = {g[2], g[0], g[1]};  // month/day/year
  return g[0].size() == 4 ? g[0] + "-" + two_digits(g[1]) + "-" + two_digits(g[2]) : std::string();
}

/// The letters and digits of a name in lower case. With `word`, only those before the first other character.
std::string plain(std::string_view name, bool word) {
  std::string out;
  for (const char c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
    if (is_letter || is_digit(c))
      out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    else if (word && !out.empty())
      break;
  }
  return out;
}

/// A key that is equal for all entries of one earthquake. It is empty if an entry has no name or no date.
std::string earthquake_of(const Entry& entry) {
  if (!entry.event.empty()) return entry.event;
  const Observation& o = entry.observation;
  const std::string day = day_of(o.date), name = plain(o.name, day.size() > 4);
  return day.empty() || name.empty() ? std::string() : name + ", " + day + ",";
}

/// The stress in Pa that each source of an earthquake means, with its file and line.
struct SourceStress {
  std::string place;
  double stress_pa;
};
using ByEarthquake = std::map<std::string, std::vector<SourceStress>>;

void add_source(ByEarthquake& sources, const Entry& entry, const medium::Defaults& defaults) try {
  const Observation& o = entry.observation;
  const std::string earthquake = earthquake_of(entry);
  if (earthquake.empty()) return;
  const Estimate e = estimate(o, defaults, true);
  const auto& stress = e.stress_pa ? e.stress_pa : e.stress_pa_bound;
  if (!stress) return;
  sources[earthquake].push_back({o.file + ":" + std::to_string(o.line), stress->value});
} catch (const InputError&) {  // the result of this entry reports the error
}

void warn_of_disagreement(const ByEarthquake& sources, Entry& entry) {
  const auto found = sources.find(earthquake_of(entry));
  if (found == sources.end()) return;
  const auto [least, most] =
      std::minmax_element(found->second.begin(), found->second.end(),
                          [](const SourceStress& a, const SourceStress& b) { return a.stress_pa < b.stress_pa; });
  if (!(most->stress_pa > most_disagreement * least->stress_pa)) return;
  entry.observation.warnings.push_back("sources of " + found->first + " disagree: stress from " +
                                       digits(least->stress_pa / 1e6, 3) + " MPa (" + least->place + ") to " +
                                       digits(most->stress_pa / 1e6, 3) + " MPa (" + most->place + ")");
}

}  // namespace

void warn_of_other_sources(std::vector<Entry>& entries, const medium::Defaults& defaults) {
  ByEarthquake sources;
  for (const Entry& entry : entries)
    if (!entry.error) add_source(sources, entry, defaults);
  for (Entry& entry : entries)
    if (!entry.error) warn_of_disagreement(sources, entry);
}

}  // namespace slipfront::finite_fault
