#include "events/finite_fault/sources.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include "math/digits.hpp"
#include "text/characters.hpp"

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
