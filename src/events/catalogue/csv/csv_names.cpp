#include <algorithm>
#include <map>

#include "events/catalogue/csv/csv.hpp"
#include "text/characters.hpp"

namespace slipfront::catalogue {
namespace {

struct Name {
  Word kind;
  std::string_view meaning, spellings;  ///< spellings in small letters, without blanks inside, separated by blanks
};

/// All words that the reader of tables knows, in addition to the names of the quantities. A word can have several
/// kinds.
constexpr Name names[] = {
    {Word::quantity, "rupture_velocity",
     "rupturespeed rupturepropagationvelocity rupturepropagationspeed propagationvelocity propagationspeed "
     "propagationrate migrationvelocity migrationspeed migrationrate frontvelocity frontspeed vr rv vrup avvr"},
    {Word::quantity, "slip_velocity", "sliprate slipspeed slidingvelocity slippingvelocity"},
    {Word::quantity, "rise_time", "avtr"},
    {Word::quantity, "stress_drop", "delta\xCF\x83 \xCE\x94\xCF\x83"},
    {Word::quantity, "normal_stress", "effectivenormalstress sigman \xCF\x83n"},
    {Word::quantity, "shear_stress", "tau \xCF\x84 shearstressbefore stressbefore initialshearstress initialstress"},
    {Word::quantity, "shear_stress_after",
     "tauafter shearstressafter stressafter residualshearstress residualstress finalshearstress finalstress"},
    {Word::quantity, "shear_modulus", "rigidity"},
    {Word::quantity, "poisson_ratio", "poissonsratio poisson'sratio"},
    {Word::quantity, "s_wave_speed", "swavevelocity shearwavevelocity shearwavespeed vsathypocentre vsathypocenter vs"},
    {Word::quantity, "p_wave_speed", "pwavevelocity vpathypocentre vpathypocenter vp"},
    {Word::quantity, "moment", "m0 mo scalarmoment seismicmoment"},
    {Word::quantity, "moment_magnitude", "mw magnitudemw"},
    {Word::quantity, "rupture_length", "length faultlength alongstrikelength lengthalongstrike"},
    {Word::quantity, "rupture_width", "width faultwidth downdipwidth"},
    {Word::quantity, "rupture_area", "area faultarea sliparea"},
    {Word::text, "name", "name event eventname earthquake front"},
    {Word::text, "identifier", "evid eventid id no #"},
    {Word::text, "date", "date datetime origintime"},
    {Word::text, "start", "start startdate starttime startyear datestart tstart begin begindate datebegin"},
    {Word::text, "end", "end enddate endtime endyear dateend tend"},
    {Word::text, "year", "year yyyy yr"},
    {Word::text, "month", "month"},
    {Word::text, "day", "day"},
    {Word::text, "kind", "kind"},
    {Word::text, "citation", "citation source"},
    {Word::text, "note", "note notes"},
    {Word::text, "study", "study"},
    {Word::text, "slip_velocity_is", "slipvelocityis"},
    {Word::text, "rupture_velocity_is", "rupturevelocityis"},
    {Word::text, "stress_drop_is", "stressdropis"},
    {Word::text, "front_threshold", "frontthreshold"},
    {Word::unused, "ignore",
     "lat latitude lon long lng longitude depth dep strike dip rake ml mb ms md m mag magnitude magtype type number "
     "index doi url reference ref region location place zone fault segment mechanism time hour minute second hh mm ss "
     "comment comments agency catalog tag eventtag x y z evlo evla evdp authors author longitudedeg latitudedeg "
     "lastname mww momentmagnitudetype"},
    {Word::neutral, "neutral",
     "mean average avg ave av estimated est est. observed obs measured seismic geodetic coseismic source event rupture "
     "fault total local"},
    {Word::physical, "physical",
     "velocity speed slip stress rate drop duration moment energy modulus frequency length width area radius strain "
     "friction displacement efficiency rigidity period pressure density sliprate stressdrop risetime fc offset "
     "viscosity"},
    {Word::about, "how", "how"},
    {Word::about, "ignore", "type source method note notes"},
    {Word::prefix, "largest", "peak max maximum"},
    {Word::prefix, "apparent", "apparent"},
    {Word::prefix, "static", "static"},
    {Word::range, "low", "min minimum"},
    {Word::range, "high", "max maximum"},
    {Word::error, "1",
     "err error errors sd std stdev stddev sigma unc uncertainty +- +/- \xC2\xB1 \xCF\x83 1\xCF\x83 1sigma 1-sigma "
     "stderr"},
    {Word::error, "2", "2\xCF\x83 2sigma 2-sigma 2sd"},
    {Word::above, "always", "plus +"},
    {Word::above, "of an error", "upper up pos"},
    {Word::below, "always", "minus -"},
    {Word::below, "of an error", "lower low neg"},
    {Word::patch, "slip", "slip strikeslip dipslip"},
    {Word::patch, "slip of a patch", "ss ds"},
    {Word::patch, "x", "lat latitude x x==ew x==ns easting east"},
    {Word::patch, "y", "lon long longitude lng y y==ns y==ew northing north"},
    {Word::patch, "depth", "depth dep z top"},
    {Word::patch, "patch", "rake strike dip trup rise segment subfault patch length rupture tini"},
    {Word::absent, "absent",
     "nan -nan n/a na n.a. null none - -- --- ? * n.d. unknown ... \xE2\x80\x93 \xE2\x80\x94 \xE2\x80\xA6 \xC2\xA0 "
     "\xE2\x88\x92"},
};

using Index = std::map<std::pair<Word, std::string>, std::string_view, std::less<>>;

Index index_of_names() {
  Index index;
  for (const Name& name : names)
    for (std::string_view rest = name.spellings; !rest.empty();) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      index.emplace(std::pair(name.kind, rest.substr(0, end)), name.meaning);
      rest = trimmed(rest.substr(end));
    }
  for (const auto* keys : {&quantity_keys(), &front_keys()})
    for (const Key& key : *keys) {
      std::string joined(key.name);
      joined.erase(std::remove(joined.begin(), joined.end(), '_'), joined.end());
      index.emplace(std::pair(Word::quantity, std::move(joined)), key.name);
    }
  return index;
}

}  // namespace

std::string_view meaning_of(std::string_view word, Word kind) {
  static const Index index = index_of_names();
  const auto at = index.find(std::pair(kind, std::string(word)));
  return at == index.end() ? std::string_view() : at->second;
}

bool is_absent(std::string_view cell, const std::vector<std::string>& missing) {
  cell = trimmed(cell);
  if (cell.empty() || std::find(missing.begin(), missing.end(), cell) != missing.end()) return true;
  if (!meaning_of(small_letters(cell), Word::absent).empty()) return true;
  const auto number = medium::number(cell);
  return number && (*number == -99 || *number == -999 || *number == -9999);
}

}  // namespace slipfront::catalogue
