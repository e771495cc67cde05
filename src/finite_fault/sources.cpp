#include "finite_fault/sources.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include "foundation/text/characters.hpp"
#include "foundation/text/digits.hpp"

namespace slipfront::finite_fault {

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
std::string earthquake_of(const Observation& o) {
  const std::string day = day_of(o.date), name = plain(o.name, day.size() > 4);
  return day.empty() || name.empty() ? std::string() : name + ", " + day + ",";
}

/// The stress in Pa that each source of an earthquake means, with its file and line.
struct SourceStress {
  std::string place;
  double stress_pa;
};
using ByEarthquake = std::map<std::string, std::vector<SourceStress>>;

void add_source(ByEarthquake& sources, const Observation& o, const medium::Defaults& defaults) try {
  const std::string earthquake = earthquake_of(o);
  if (earthquake.empty()) return;
  const Estimate e = estimate(o, defaults, true);
  const auto& stress = e.stress_pa ? e.stress_pa : e.stress_pa_bound;
  if (!stress) return;
  sources[earthquake].push_back({o.file + ":" + std::to_string(o.line), stress->value});
} catch (const InputError&) {  // the result of this entry reports the error
}

void warn_of_disagreement(const ByEarthquake& sources, Observation& o) {
  const auto found = sources.find(earthquake_of(o));
  if (found == sources.end()) return;
  const auto [least, most] =
      std::minmax_element(found->second.begin(), found->second.end(),
                          [](const SourceStress& a, const SourceStress& b) { return a.stress_pa < b.stress_pa; });
  if (!(most->stress_pa > most_disagreement * least->stress_pa)) return;
  o.warnings.push_back("sources of " + found->first + " disagree: stress from " + digits(least->stress_pa / 1e6, 3) +
                       " MPa (" + least->place + ") to " + digits(most->stress_pa / 1e6, 3) + " MPa (" + most->place +
                       ")");
}

}  // namespace

void warn_of_other_sources(std::vector<Entry>& entries, const medium::Defaults& defaults) {
  ByEarthquake sources;
  for (const Entry& entry : entries)
    if (!entry.error) add_source(sources, entry.observation, defaults);
  for (Entry& entry : entries)
    if (!entry.error) warn_of_disagreement(sources, entry.observation);
}

}  // namespace slipfront::finite_fault
