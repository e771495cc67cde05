// Tables in the layouts of published ones. They are made up; docs/howto/published_tables.md describes the layouts.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "events/catalogue/keys.hpp"
#include "slipfront/error.hpp"
#include "slipfront/events/catalogue/read.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;

std::string number(double x) {
  std::ostringstream out;
  out.precision(6);
  out << x;
  return out.str();
}

std::string text_of(const MeasuredValue& m) {
  switch (m.shape) {
    case MeasuredValue::Shape::range:
      return number(m.low) + (m.is_exact() ? "" : ".." + number(m.high));
    case MeasuredValue::Shape::normal:
      return number(m.low) + "+-" + number(m.spread);
    case MeasuredValue::Shape::lognormal:
      return number(m.low) + "*/" + number(m.spread);
    case MeasuredValue::Shape::split:
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
    {"a header with another separator than the rows",
     "# Number ; Longitude ; Duration (days) ; Mw\n1 -98.5 5 6.8\n2  -98.7\t9 6.6\n",
     "line 2 duration=432000 moment_magnitude=6.8\nline 3 duration=777600 moment_magnitude=6.6\n"},
    {"a first row with too few cells", "name,Vr (km/s),slip (m)\nA B C,2.7\nE F G,2.7,1\n",
     "!2 : the row has 2 cells\nE F G rupture_velocity=2700 slip=1\n"},
    {"blanks between the cells", "# event   slip_m  \"rise time [s]\" \n  A   1.2   3\n\"B 2\" 1 4\n",
     "A slip=1.2 rise_time=3\nB 2 slip=1 rise_time=4\n"},
    {"start and end in years", "start, end, slip_cm\n2014.5, 2014.6, 3\n2015,2016,3\n2014.6, 2014.5, 3\n",
     "line 2 2014.5 slip=0.03 duration=3.1536e+06\nline 3 2015 slip=0.03\nline 4 2014.6 slip=0.03\n"},
    {"start and end as dates",
     "name,start date,End Date (UTC),slip_cm,duration_days\nA,2014-05-23,2014-06-02,3,\nB,2014-05-23 "
     "06:00,2014-05-24T18:00,3,\n"
     "C,2014-05-23,2014-06-02,3,5\nE,2014-02-30,2014-06-02,3,\n",
     "A 2014-05-23 slip=0.03 duration=864000\nB 2014-05-23 06:00 slip=0.03 duration=129600\n"
     "C 2014-05-23 slip=0.03 duration=432000\nE 2014-02-30 slip=0.03\n"},
    {"start and end of a length", "name,start (km),end (km),slip_m\nA,1,2,3\n", "A slip=3\n? start (km)\n? end (km)\n"},
    {"a column without unit", "name,Duration,slip_cm\na,14,3\nb,15,3\n",
     "!1 Duration: no unit in the title, below it or in its cells\n"},
    {"a column of sizes without unit", "name,length,slip_cm\na,14,3\nb,15,3\n", "a slip=0.03\nb slip=0.03\n"},
    {"sizes with units in some cells", "name,length,slip_cm\na,14 km,3\nb,15,3\n",
     "a slip=0.03 rupture_length=14000\nb slip=0.03\n"},
    {"units in some cells", "name,Duration,slip_cm\na,14 days,3\nb,15,3\n",
     "a slip=0.03 duration=1.2096e+06\n!3 Duration: a number without a unit\n"},
    {"errors in the power of ten of the title", "name,M0 (10^18 N m),M0_err,duration_s\nA,3.2 +- 0.1,,5\nB,3,0.5,5\n",
     "A duration=5 moment=3.2e+18+-1e+17\nB duration=5 moment=3e+18+-5e+17\n"},
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

TEST(Dialects, ReadsTablesWithoutHeaderByAMap) {
  const std::string text = "# no titles\nkindA, 1998, 17.26, 6.65, 175\nkindB, 2001, 17.27, 7.65, 415\n";
  EXPECT_EQ(summary(text), "!2 : no line has the titles of the columns\n");
  EXPECT_EQ(
      summary(
          text,
          "[columns]\n1 = \"kind\"\n2 = \"year\"\n3 = \"ignore\"\n4 = \"moment_magnitude\"\n5 = \"duration days\"\n"),
      "line 2 1998 duration=1.512e+07 moment_magnitude=6.65\nline 3 2001 duration=3.5856e+07 "
      "moment_magnitude=7.65\n");
  EXPECT_EQ(summary(text, "[columns]\n6 = \"slip m\"\n"), "!2 columns.6: no column has this title\n");
  EXPECT_EQ(summary("event,b,c\nA,1,2\n", "[columns]\n1 = \"name\"\n2 = \"slip m\"\n"), "A slip=1\n? c\n");
}

TEST(Dialects, ReadsTablesSeparatedByBlanksByAMap) {
  EXPECT_EQ(summary("year month day len wid slip dur\n2007 09 08  56 52.5 0.0339\t5 \n",
                    "separator = \" \"\n[columns]\n\"slip\"=\"slip m\"\n\"dur\"=\"duration "
                    "days\"\n\"len\"=\"rupture_length km\"\n"),
            "line 2 2007-09-08 slip=0.0339 duration=432000 rupture_length=56000\n? wid\n");
}

TEST(Dialects, ReadsUnitsWithAFactor) {
  EXPECT_EQ(summary("name,M,d\na,2.2,30\nb,2e18 N m,30\n",
                    "[columns]\n\"M\" = \"moment 1e19 N m\"\n\"d\" = \"duration 0.5 days\"\n"),
            "a duration=1.296e+06 moment=2.2e+19\nb duration=1.296e+06 moment=2e+18\n");
  EXPECT_EQ(summary("name,M\na,2\n", "[columns]\n\"M\" = \"moment 1e19 km\"\n"),
            "!2 columns.M: the unit 'km' is not that of a seismic moment\n");
}

TEST(Dialects, AMapOfTheColumnsChangesNothingUntilItIsEdited) {
  const auto events = [](const std::string& all) { return all.substr(0, all.find("?")); };  // without ignored columns
  for (const Dialect& d : dialects) {
    const TableDescription table = describe_table(d.text, "t.csv");
    if (std::string_view(d.expected).starts_with("!1 ")) continue;
    EXPECT_EQ(summary(d.text, table.map), events(summary(d.text))) << d.name << table.map;
  }
}

TEST(Dialects, DescribesColumnsThatAreNotUsed) {
  const auto reason = [](std::string_view text) { return describe_table(text, "t.csv").columns.back().reason; };
  EXPECT_EQ(reason("name,slip_m,lat\nA,1,2\n"), "slipfront does not need it");
  EXPECT_EQ(reason("name,slip_m,fc (Hz)\nA,1,2\n"), "no name of a quantity");
  EXPECT_EQ(reason("name,slip_m,Vr (Hz)\nA,1,2\n"),
            "the unit 'Hz' is not that of a velocity; allowed: a velocity, such as 3.0 km/s or 10 km/day");
  EXPECT_EQ(reason("name,slip_m,mean_slip_cm\nA,1,2\n"),
            "a second column of slip besides 'slip_m'; allowed: one; --columns map.toml can ignore the other");
  EXPECT_EQ(
      describe_table("name,slip_m,fc (Hz)\nA,1,2\n", "t.csv").map,
      "# t.csv: a line without '#' changes how its column is read.\n[columns]\n# 'name' = 'name'\n# 'slip_m' = 'slip "
      "m'\n'fc (Hz)' = 'ignore'  # no name of a quantity\n");
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
  EXPECT_EQ(
      summary("{\"properties\": {\"mag\": 7, \"title\": \"M 7\", \"products\": {\"finite-fault\": [{\"properties\": "
              "{\"average-rupture-velocity\": \"3.1\", \"scalar-moment\": \"4e19\"}}]}}}"),
      "M 7 rupture_velocity=3100 moment=4e+19\n");
  EXPECT_EQ(summary("{\"average-rise-time\": \"2.1\", \"eventsource\": \"us\", \"location\": \"19km SSW of Nowhere\"}"),
            "19km SSW of Nowhere rise_time=2.1\n");
  EXPECT_EQ(summary("{\"features\": [{\"properties\": {\"slip\": 1.2}}]}"),
            "!1 : the subfaults of a finite-fault model\n");
  EXPECT_EQ(summary("{\"features\": []}"), "!1 : no features\n");
  EXPECT_EQ(summary("{ broken"), "!1 : not a JSON object\n");
}

TEST(ReadEvents, NamesFilesOfOtherKinds) {
  const auto refusal = [](std::string_view text, const char* file) {
    std::string all;
    read_events(text, file, [&](Entry&& entry) { all += entry.error ? entry.error->problem : entry.observation.name; });
    return all;
  };
  const auto is = [](const std::string& kind) {
    return "this is " + kind + ": slipfront reads no such file as events";
  };
  EXPECT_EQ(refusal("PK\x03\x04 abc", "t.xlsx"), is("an Excel workbook or another ZIP archive"));
  EXPECT_EQ(refusal("\x89HDF\r\n", "t.nc"), is("a NetCDF file (HDF5)"));
  EXPECT_EQ(refusal(std::string("ab\x01\x02xyz\x03\x04\n,;\xff", 13), "t.bin"), is("no text, but binary data"));
  EXPECT_EQ(refusal("%PDF-1.4\n", "t.pdf"), is("a PDF document"));
  EXPECT_EQ(refusal("PDEW2010  2 27 6 34\nevent name:  X\nhalf duration: 60.0\nMrr: 1.0e29\n", "CMTSOLUTION"),
            is("a moment tensor (CMTSOLUTION)"));
  EXPECT_EQ(refusal("2.0\n# c\nPLANE 1\n0 0 6 4 12 8\n0 90 2 1 4\nPOINTS 1\n", "t.srf"), "the file is cut short");
  EXPECT_EQ(refusal("title = \"x\"\n[initial]\n", "t.toml"), is("a scenario"));
  EXPECT_EQ(refusal("[initial]\n[event]\nname = \"both\"\n", "t.toml"), "both");
  EXPECT_EQ(refusal("# stf\n0 0\n0.1 1e17\n0.2 2e17\n0.3 1e17\n0.4 0\n", "t.stf"),
            "this is a source time function or another series of two columns: slipfront reads no such file as a table "
            "of events");
  EXPECT_EQ(refusal("rupture_velocity_km_s slip_m\n1 1\n2 1\n3 1\n2 2\n2 3\n", "t.csv"),
            "line 2line 3line 4line 5line 6");
}

}  // namespace
