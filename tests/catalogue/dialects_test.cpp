// Tables in the layouts of published ones. They are made up; docs/howto/published_tables.md describes the layouts.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "catalogue/keys.hpp"
#include "slipfront/catalogue/read.hpp"
#include "slipfront/error.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;

std::string number(double x) {
  std::ostringstream out;
  out.precision(6);
  out << x;
  return out.str();
}

std::string text_of(const Measured& m) {
  switch (m.shape) {
    case Measured::Shape::range:
      return number(m.low) + (m.is_exact() ? "" : ".." + number(m.high));
    case Measured::Shape::normal:
      return number(m.low) + "+-" + number(m.spread);
    case Measured::Shape::lognormal:
      return number(m.low) + "*/" + number(m.spread);
    case Measured::Shape::split:
      break;
  }
  return number(m.low) + "+" + number(m.spread) + "-" + number(m.spread_below);
}

/// All that was read of an entry, in SI units: "name date quantity=value ...", or "!line key: problem".
std::string text_of(const Entry& entry) {
  if (entry.error)
    return "!" + std::to_string(entry.error->line) + " " + entry.error->key + ": " + entry.error->problem;
  const Observation& o = entry.observation;
  std::string text = o.name + (o.date.empty() ? "" : " " + o.date);
  for (const Key& key : quantity_keys()) {
    const std::string name(key.name);
    if (key.measured && o.*key.measured) text += " " + name + "=" + text_of(*(o.*key.measured));
    if (!key.constant || !(o.*key.constant)) continue;
    text += " " + name + "=" + number(*(o.*key.constant));
    for (const UncertainConstant& c : o.uncertain_constants)
      if (c.member == key.constant) text += "(" + text_of(c.measured) + ")";
  }
  for (const Bound& b : o.bounds) text += " " + b.quantity + (b.is_upper ? "<" : ">") + number(b.limit);
  if (o.slip_velocity_is) text += std::string(" is ") + name_of(*o.slip_velocity_is);
  return text;
}

/// The entries, one a line, and the columns that look like quantities and were not understood.
std::string summary(std::string_view text, const std::string& map = {}) {
  std::string all;
  const TableNotes notes = read_events(text, text.starts_with("{") ? "t.json" : "t.csv",
                                       [&](Entry&& entry) { all += text_of(entry) + "\n"; }, {map, "map.toml"});
  for (const std::string& title : notes.ignored_quantities) all += "? " + title + "\n";
  return all;
}

struct Dialect {
  const char* name;
  const char* text;
  const char* expected;
};

constexpr Dialect dialects[] = {
    {"quoted preamble, units in the titles",
     "\"General Policy\"\n\"  Cite our paper (*1)\"\n\" \"\nyear,month,day,lat,lon,mag,length (km),width (km),slip "
     "(m),duration (s)\n"
     "2015,12,3,35.0,136.9,5.7,49,29,0.008,172800.00\n",
     "line 5 2015-12-03 slip=0.008 duration=172800 rupture_length=49000 rupture_width=29000\n"},
    {"preamble with commas",
     "Table S1. Slip, duration and Mw of events, see text\nEvent,Slip (cm),Duration (days)\nA,3.5,14\n",
     "A slip=0.035 duration=1.2096e+06\n"},
    {"header behind a sign", "# evid,Ml,Mw,fc,n,stressdrop (MPa)\n1,4.2,4.3,2.2,2.7,59.8\n",
     "1 moment_magnitude=4.3 stress_drop=5.98e+07\n? fc\n? n\n"},
    {"comments before, between and after",
     "# slow slip\n# decimal points\nname,slip_cm,duration_days\n# 2003\nA,3,10\n\n% 2004\nB,4,20\n# end\n",
     "A slip=0.03 duration=864000\nB slip=0.04 duration=1.728e+06\n"},
    {"capital letters and brackets", "EVENT,RUPTURE VELOCITY [KM/S],Slip Velocity [m/s]\nA,2.7,0.5\n",
     "A rupture_velocity=2700 slip_velocity=0.5\n"},
    {"symbols with units", "Earthquake,Mw,VR [km/s],Vs [km/s],\xCE\x94\xCF\x83 (MPa)\nA,7.1,2.7,3.4,3\n",
     "A rupture_velocity=2700 moment_magnitude=7.1 stress_drop=3e+06 s_wave_speed=3400\n"},
    {"short name with a suffix", "name,Vr_km_s,Vr_km_s_err\nA,2.7,0.2\n", "A rupture_velocity=2700+-200\n"},
    {"units below the header", "name,rupture velocity,slip,duration\n,km/s,(m),[s]\nA,2.7,1.5,20\n",
     "A rupture_velocity=2700 slip=1.5 duration=20\n"},
    {"errors with endings", "name,slip_cm,slip_err_cm,stress_drop (kPa),stress_drop_sd (kPa)\nA,3,0.5,50,12\n",
     "A slip=0.03+-0.005 stress_drop=50000+-12000\n"},
    {"errors in front", "name,Vr (km/s),err_Vr (km/s),sigma slip (m),slip (m)\nA,2.7,0.2,0.1,1\n",
     "A rupture_velocity=2700+-200 slip=1+-0.1\n"},
    {"errors of two standard deviations", "name,Slip (mm),Slip 2sigma (mm)\nA,20,4\n", "A slip=0.02+-0.002\n"},
    {"bare errors", "name,Vr (km/s),\xC2\xB1,Duration (s),err\nA,2.7,0.2,30,3\n",
     "A rupture_velocity=2700+-200 duration=30+-3\n"},
    {"plus and minus columns", "name,Vr (km/s),Vr_err_plus,Vr_err_minus\nA,2.7,0.3,0.1\nB,2.7,0.2,-0.2\n",
     "A rupture_velocity=2700+300-100\nB rupture_velocity=2700+-200\n"},
    {"bare plus and minus", "name,Stress drop (MPa),+,-\nA,3.0,1.2,0.8\n", "A stress_drop=3e+06+1.2e+06-800000\n"},
    {"a sign in the title of the value", "name,Vr \xC2\xB1 1\xCF\x83 (km/s),slip (m)\nA,2.7 \xC2\xB1 0.2,1\n",
     "A rupture_velocity=2700+-200 slip=1\n"},
    {"errors that name their quantity in parentheses",
     "name,Vr (km/s),slip (m),\xCF\x83(Vr),err (slip)\nA,2.7,1,0.2,0.1\n",
     "A rupture_velocity=2700+-200 slip=1+-0.1\n"},
    {"an error with its own unit", "name,Vr (km/s),err (m/s),sd (MPa)\nA,2.7,200,3\n",
     "A rupture_velocity=2700+-200\n? sd (MPa)\n"},
    {"an error without its value", "name,Vr (km/s),slip_err (m)\nA,2.7,0.1\n",
     "A rupture_velocity=2700\n? slip_err (m)\n"},
    {"errors in percent", "name,Vr (km/s),Vr error (%)\nA,2.7,10\n", "A rupture_velocity=2700+-270\n"},
    {"tabs", "Event\tRupture speed (km/day)\tSlip (cm)\nA\t8.5\t2.1\n", "A rupture_velocity=0.0983796 slip=0.021\n"},
    {"semicolons", "name;rupture_velocity_km_s;slip_m\nA;2.7;1.2\nB;2,7;1.2\n",
     "A rupture_velocity=2700 slip=1.2\n!3 rupture_velocity_km_s: a comma inside a number\n"},
    {"declared decimal commas", "# decimal: ,\nname;Vr (km/s);slip_m\nA;2,7 \xC2\xB1 0,2;1,25\nB;1.234,5;1\n",
     "A rupture_velocity=2700+-200 slip=1.25\n!4 Vr (km/s): a point and a decimal comma\n"},
    {"Latin-1",
     "name,Vr (km/s)\nK\xF6"
     "ln,2.7 \xB1 0.2\nB,2.5\x96"
     "3.0\n",
     "K\xC3\xB6ln rupture_velocity=2700+-200\nB rupture_velocity=2500..3000\n"},
    {"ranges in words",
     "name,rupture_velocity_km_day,slip_cm\nA,5 to 10,2\xE2\x80\x93"
     "4\nB,5-10,2..4\n",
     "A rupture_velocity=0.0578704..0.115741 slip=0.02..0.04\nB rupture_velocity=0.0578704..0.115741 "
     "slip=0.02..0.04\n"},
    {"unequal errors and digits in parentheses", "name,Vr (km/s),slip (m)\nA,2.7 +0.3/-0.1,1.20(15)\n",
     "A rupture_velocity=2700+300-100 slip=1.2+-0.15\n"},
    {"bounds and signs", "name,Vr (km/s),slip (m)\nA,<2.7,~1.2\nB,>= 1.5,1\n",
     "A slip=1.2 rupture_velocity<2700\nB slip=1 rupture_velocity>1500\n"},
    {"placeholders",
     "name,Vr (km/s),slip (m),duration (s)\nA,NaN,-999,n/a\nB,-,1,--\nC,null,?,-99.0\nE,N/A,none,\xE2\x80\x94\n",
     "A\nB slip=1\nC\nE\n"},
    {"dates in columns",
     "Year,Month,Day,Hour,Lat.,Lon.,Depth (km),Mw,Source duration (s)\n2011,3,11,5,38.1,142.9,29,9.1,150\n",
     "line 2 2011-03-11 duration=150 moment_magnitude=9.1\n"},
    {"moment and size",
     "Event,M0 (N m),Length (km),Width (km),Duration (days)\nA,3.2e18,60,40,20\nB,1.1 x 10^19,80,50,31\n",
     "A duration=1.728e+06 rupture_length=60000 rupture_width=40000 moment=3.2e+18\n"
     "B duration=2.6784e+06 rupture_length=80000 rupture_width=50000 moment=1.1e+19\n"},
    {"moment with a power of ten in the title",
     "Event,Moment (10^18 Nm),Area (km^2),slip rate (mm/day)\nA,3.2,2400,1.5\n",
     "A slip_velocity=1.73611e-08 rupture_area=2.4e+09 moment=3.2e+18\n"},
    {"largest values",
     "Event,Year,Duration (Days),Maximum Slip D (mm),Stress Drop (kPa),Peak Slip Velocity V (cm/yr),Downdip Width "
     "(km),Mw\n"
     "X,2004,17,180,51.7,386.5,46,6.3\n",
     "X 2004 slip_velocity=1.22477e-07 slip=0.18 duration=1.4688e+06 rupture_width=46000 moment_magnitude=6.3 "
     "stress_drop=51700 is peak\n"},
    {"mean and largest slip", "name,mean_slip_m,max_slip_m,rise_time_s\nA,1.2,4.5,3\n", "A slip=1.2 rise_time=3\n"},
    {"energies and frequencies", "name,Vr (km/s),Er (J),apparent stress (MPa),Radius (km)\nA,2.7,1e12,0.3,4\n",
     "A rupture_velocity=2700\n? Er (J)\n? apparent stress (MPa)\n? Radius (km)\n"},
    {"half duration and log moment", "name,half duration (s),log10 M0,duration (s)\nA,5,18.2,10\n",
     "A duration=10\n? half duration (s)\n? log10 M0\n"},
    {"long-term slip rate", "fault,slip rate (mm/yr),Vr (km/s)\nF,20,2.7\n",
     "line 2 rupture_velocity=2700\n? slip rate (mm/yr)\n"},
    {"subfaults",
     "segment,lon (deg),lat (deg),depth (m),slip (m),rake (deg),rupture time (s),length (m),width (m)\n"
     "1,172.07,-43.59,984.9,1.56,152.4, ,1000,1000\n",
     "!1 : a table of subfaults (slip at positions and depths), not of events\n"},
    {"subfaults in km", "x,y,z,slip,rake,trup,rise\n0,0,5,1.2,90,0.5,1\n",
     "!1 : a table of subfaults (slip at positions and depths), not of events\n"},
    {"no units", "Event, Mw, Mw_error, Duration, Duration_error, Depth\n1, 5.99, 0.05, 36.2, 3.61, 43.06\n",
     "!2 Duration: a number without a unit\n"},
    {"no known column", "station,latitude,longitude,delay\nA,1,2,3\n", "!1 : the header names no observed quantity\n"},
    {"empty columns at the end", "name,slip_m,,\nA,1,,\n,,,\nB,2,,\n", "A slip=1\nB slip=2\n"},
    {"two columns of one quantity", "name,slip_m,mean_slip_cm\nA,1,100\n",
     "!1 mean_slip_cm: a second column of slip besides 'slip_m'\n"},
    {"old line ends", "name,slip_m\rA,1\rB,2\r", "A slip=1\nB slip=2\n"},
};

TEST(Dialects, AreReadOrRefusedWithLineAndReason) {
  EXPECT_GE(std::size(dialects), 30U);
  for (const Dialect& d : dialects) EXPECT_EQ(summary(d.text), d.expected) << d.name;
}

TEST(Dialects, ReadsColumnsThatAMapNames) {
  const std::string map =
      "decimal = \",\"\nseparator = \";\"\nskip_lines = 1\nmissing = [\"-9\"]\n[columns]\n\"A1\" = \"rupture_velocity "
      "km/s\"\n"
      "\"A2\" = \"error of rupture_velocity\"\n\"A3\" = \"ignore\"\n\"Ort\" = \"name\"\n";
  EXPECT_EQ(summary("slip;slip\nOrt;A1;A2;A3\nX;2,7;0,2;5\nY;-9;-9;1\n", map), "X rupture_velocity=2700+-200\nY\n");
}

TEST(Dialects, RejectsWrongMaps) {
  const auto refusal = [](const std::string& map) { return summary("name,Q\nA,1\n", map); };
  EXPECT_EQ(refusal("[columns]\n\"Q\" = \"ruptur_velocity km/s\"\n"), "!2 columns.Q: unknown quantity\n");
  EXPECT_EQ(refusal("[columns]\n\"Q\" = \"slip km/s\"\n"), "!2 columns.Q: the unit 'km/s' is not that of a length\n");
  EXPECT_EQ(refusal("[columns]\n\"Q\" = \"slip m\"\n\"R\" = \"ignore\"\n"), "!3 columns.R: no column has this title\n");
  EXPECT_EQ(refusal("decimals = \",\"\n"), "!1 decimals: unknown key\n");
  EXPECT_EQ(refusal("separator = \"x\"\n"), "!1 separator: not a separator\n");
  EXPECT_EQ(refusal("skip_lines = -1\n"), "!1 skip_lines: not a number of lines\n");
  EXPECT_EQ(refusal("missing = \"x\"\n"), "!1 missing: not a list\n");
}

TEST(Json, ReadsEventsOfUsgs) {
  EXPECT_EQ(
      summary("{\"type\": \"Feature\", \"id\": \"us1\", \"properties\": {\"mag\": 7.1, \"magType\": \"mww\", \"time\": "
              "1467331200000, \"title\": \"M 7.1 - Somewhere\"}}"),
      "!1 : 'M 7.1 - Somewhere' of 2016-07-01, magnitude 7.1 has no quantity that slipfront uses\n");
  EXPECT_EQ(summary("{\"eventtime\": \"2016-07-01T00:00:00.000Z\", \"average-rupture-velocity\": \"2.5\", "
                    "\"average-rise-time\": \"4.0\", \"derived-magnitude\": \"7.1\", \"scalar-moment\": \"5.6e19\"}"),
            "t.json 2016-07-01 rupture_velocity=2500 rise_time=4 moment=5.6e+19 moment_magnitude=7.1\n");
  EXPECT_EQ(summary("{\"features\": [{\"properties\": {\"slip\": 1.2}}]}"),
            "!1 : the subfaults of a finite-fault model\n");
  EXPECT_EQ(summary("{\"features\": []}"), "!1 : no features\n");
  EXPECT_EQ(summary("{ broken"), "!1 : not a JSON object\n");
}

}  // namespace
