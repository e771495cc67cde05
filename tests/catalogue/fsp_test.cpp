// The reader of finite-fault models (.fsp): values that it reads, and warnings.

#include "events/catalogue/fault_model.hpp"
#include "fsp_texts.hpp"

namespace slipfront::catalogue {
namespace {

TEST(Fsp, ReadsASingleSrcmodSegment) {
  const Observation o = read(text_of("fsp_srcmod_single"));
  EXPECT_EQ(o.name, "Northern Nowhere (Calif.)");
  EXPECT_EQ(o.date, "02/30/1901");
  EXPECT_EQ(o.kind, "earthquake");
  EXPECT_EQ(o.citation, "Nobody and Noone (1902); EventTAG s1901NOWHERnobo");
  EXPECT_EQ(o.file, "m.fsp");
  EXPECT_EQ(o.line, 3U);
  expect_value(o.rupture_velocity_m_s, 2500);
  expect_value(o.rise_time, 2);
  expect_value(o.slip, 1);
  expect_value(o.slip_velocity_m_s, 0.5);
  expect_value(o.p_wave_speed, 6000);
  expect_value(o.s_wave_speed, 3000);
  expect_value(o.density, 2500);
  expect_value(o.shear_modulus, 22.5e9);
  expect_value(o.poisson_ratio, 1.0 / 3);
  EXPECT_TRUE(o.warnings.empty());
}

TEST(Fsp, ReadsASingleUsgsSegment) {
  const Observation o = read(text_of("fsp_usgs_single"));
  EXPECT_EQ(o.name, "FAR COAST OF UTOPIA");
  EXPECT_EQ(o.date, "2031-02-29T01:02:03");
  EXPECT_EQ(o.citation, "EventTAG 2031-02-29T01:02:03");
  expect_value(o.rupture_velocity_m_s, 1500);
  expect_value(o.rise_time, 4);  // from the header, although there is a column RISE
  expect_value(o.slip_velocity_m_s, 0.625);
  expect_value(o.shear_modulus, 36.75e9);
  EXPECT_TRUE(o.warnings.empty());
}

TEST(Fsp, WeightsSegmentsByTheirArea) {
  // Subfaults have 2 km x 3 km, although LEN x WID is larger: 24 km^2 with 2.5 m, 60 km^2 with 1 m, 16 km^2 with 2.5 m.
  const Observation o = read(text_of("fsp_srcmod_segments"));
  expect_value(o.slip, (24 * 2.5 + 60 * 1 + 16 * 2.5) / 100);
  const Observation usgs = read(text_of("fsp_usgs_segments"));
  EXPECT_EQ(usgs.name, "NEAR COAST OF NOWHERE");
  EXPECT_EQ(usgs.date, "1995/02/30");
  EXPECT_EQ(usgs.citation, "Nobody (NEIC,1999); EventTAG p000000tNOBODY");
  expect_value(usgs.slip, (600 * 1.5 + 200 * 0.5) / 800);
  expect_value(usgs.slip_velocity_m_s, 0.25);
  EXPECT_TRUE(usgs.warnings.empty());
}

TEST(Fsp, WeightsSubfaultsEquallyWithoutAnArea) {
  // The header gives 15 km x 10 km for a subfault, and two subfaults for each segment.
  std::string text = edited(text_of("fsp_usgs_segments"), "% LEN = 30 km WID = 20 km\n", "");
  expect_value(read(text).slip, (300 * 1.5 + 200 * 0.5) / 500);
  text = edited(text, "% Invs : Dx = 15 km  Dz = 10 km\n", "");
  const Observation o = read(text);
  expect_value(o.slip, 1);
  EXPECT_EQ(warnings_with(o, "equal weight"), 1U);
}

TEST(Fsp, TakesRiseTimeFromItsColumnIfTheHeaderHasNone) {
  // Rows with no slip or a placeholder for RISE do not count: (1 + 2 + 6 + 8 + 1 + 8) / (10 + 2.5).
  const Observation o = read(text_of("fsp_srcmod_segments"));
  EXPECT_FALSE(o.rupture_velocity_m_s);
  expect_value(o.rise_time, 2.08);
  expect_value(o.slip_velocity_m_s, 1.6 / 2.08);
  EXPECT_EQ(warnings_with(o, "avVr = 'km/s' has no number"), 1U);
  EXPECT_EQ(warnings_with(o, "avTr = 999"), 1U);
  EXPECT_EQ(warnings_with(o, "column RISE"), 1U);
}

TEST(Fsp, IgnoresPlaceholdersOfVelocities) {
  for (const std::string value : {"0.0", "-99.0", "999.0", "99", "-1", "", "unknown", "nan", "NaN", "-nan", "-99",
                                  "-9.9e1", "+999", "9999", "-999.00", "n/a", "-"}) {
    const Observation o = read(single("avVr = 2.5 km/s", "avVr = " + value + " km/s"));
    EXPECT_FALSE(o.rupture_velocity_m_s) << value;
    EXPECT_EQ(warnings_with(o, "avVr"), 1U) << value;
    expect_value(o.slip_velocity_m_s, 0.5);
  }
  expect_value(read(single("avVr = 2.5 km/s", "avVr = 98.9 km/s")).rupture_velocity_m_s, 98900);
}

TEST(Fsp, IgnoresPlaceholdersOfRiseTimes) {
  for (const std::string value : {"0.0", "-99.0", "999.0", "900", "", "-", "nan", "NAN", "-9999"}) {
    const Observation o = read(single("avTr = 2.0 s", "avTr = " + value + " s"));
    EXPECT_FALSE(o.rise_time) << value;
    EXPECT_FALSE(o.slip_velocity_m_s) << value;
    EXPECT_EQ(warnings_with(o, "avTr"), 1U) << value;
    expect_value(o.rupture_velocity_m_s, 2500);
    expect_value(o.slip, 1);
  }
  EXPECT_EQ(warnings_with(read(single("avTr = 2.0 s    ", "")), "no avTr"), 1U);
}

TEST(Fsp, TreatsAPlaceholderInTheHeaderAsAbsent) {
  const Observation o = read(edited(single("DEP = 7.00", "DEP = nan"), "HypZ =  5.00 km", "HypZ = nan km"));
  EXPECT_EQ(warnings_with(o, "the depth of the hypocentre is not given"), 1U);
  expect_value(o.rupture_velocity_m_s, 2500);
  for (const std::string size : {"nan", "999.00", "-99", "9999"})
    expect_value(read(single("Dx  =   2.00 km", "Dx  = " + size + " km")).slip, 1);
  EXPECT_EQ(
      warnings_with(read(single("4.00       6.00       3.00        2.50", "4.00 nan 3.00 2.50")), "elastic constants"),
      1U);
}

TEST(Fsp, LeavesOutSubfaultsWithoutSlip) {
  const std::string row = "    34.990  -119.990    -2.000    -2.000     0.500     1.500   180.000";
  for (const std::string slip : {"nan", "NaN", "-99", "-99.0", "999", "-999", "9999", "-9999.00", "n/a", "-", "null"}) {
    const Observation o = read(single(row, "34.990 -119.990 -2.000 -2.000 0.500 " + slip + " 180.000"));
    expect_value(o.slip, 0.9);
    EXPECT_EQ(o.subfaults.size(), 5U) << slip;
    EXPECT_EQ(warnings_with(o, "whose slip is a placeholder, left out: 1"), 1U) << slip;
  }
  const Observation o = read(single(row, "34.990 -119.990 nan -2.000 0.500 1.500 180.000"));
  expect_value(o.slip, 1);
  EXPECT_EQ(o.subfaults.size(), 5U);
}

/// The upper row of subfaults is in water if the first layer is. The layers of water are those of SRCMOD and the USGS.
TEST(Fsp, LeavesOutTheSlipOfSubfaultsInWater) {
  for (const std::string layer : {"1.50 0.00 1.03", "1.46 0.01 1.02"}) {
    const std::string text = edited(single("0.00       3.00       1.50        2.00", "0.00 " + layer),
                                    "4.00       6.00       3.00        2.50", "2.00       6.00       3.00        2.50");
    const FaultModel model = read_fault_model(text, "m.fsp");
    expect_value(model.observation.slip, (2.0 + 0.25 + 0.75) / 3);
    EXPECT_EQ(warnings_with(model.observation, "water layer, which has no rigidity; their slip is left out: 3"), 1U);
    double share = 0;
    for (const FaultPatch& p : model.segments.front().patches) {
      const Subfault& s = model.observation.subfaults[p.row];
      EXPECT_EQ(p.slip, s.slip);
      EXPECT_EQ(p.slip == 0, p.depth < 2000);
      EXPECT_EQ(s.moment_share == 0, p.depth < 2000);
      share += s.moment_share;
    }
    EXPECT_NEAR(share, 1, 1e-15);
  }
  EXPECT_EQ(warnings_with(read(text_of("fsp_srcmod_single")), "water"), 0U);
}

/// A slip of 0 is a slip: the mean is that over the whole fault.
TEST(Fsp, CountsSubfaultsWithZeroSlip) {
  expect_value(read(single("0.500     1.500   180.000", "0.500     0.000   180.000")).slip,
               (0.5 + 1 + 2 + 0.25 + 0.75) / 6);
}

TEST(Fsp, StatesHowManySubfaultsHaveARiseTime) {
  std::string text = edited(text_of("fsp_srcmod_single"), "SLIP      RAKE", "SLIP RAKE RISE TRUP");
  text = edited(text, "avTr = 2.0 s", "avTr = 0 s");
  std::size_t row = 0;
  for (const std::string rest : {"5 1", "0 1", "900 901", "-99 999", "950 1", "999 1"}) {
    std::size_t at = text.find("180.000\n");
    ASSERT_NE(at, std::string::npos) << row++;
    text.replace(at, 8, "180.0 " + rest + "\n");
  }
  const Observation o = read(text);
  expect_value(o.rise_time, 5);
  EXPECT_EQ(warnings_with(o, "column RISE, which only 1 of 6 subfaults with slip have"), 1U);
  EXPECT_EQ(warnings_with(o, "times of 900 s or more in column RISE are taken as placeholders: 2"), 1U);
  EXPECT_EQ(warnings_with(o, "times of 900 s or more in column TRUP are taken as placeholders: 1"), 1U);
}

TEST(Fsp, ReadsExponentsOfFortran) {
  expect_value(read(single("0.500     1.500   180.000", "5.0D-01   1.5d+00   180.000")).slip, 1);
  EXPECT_TRUE(is_refused(single("0.500     1.500   180.000", "5.0D-01   1.5D   180.000")));
}

TEST(Fsp, WarnsOfAMomentFarFromThatOfTheHeader) {
  EXPECT_EQ(warnings_with(read(text_of("fsp_srcmod_single")), "times that of the header"), 0U);
  EXPECT_EQ(warnings_with(read(single("Dx  =   2.00 km", "Dx  = 2000.00 km")), "times that of the header"), 1U);
}

TEST(Fsp, LeavesABlankValueBlank) {
  const Observation o = read(single("avTr = 2.0 s    avVr = 2.5 km/s", "avTr = avVr = 2.5 km/s"));
  EXPECT_FALSE(o.rise_time);
  EXPECT_EQ(warnings_with(o, "avTr = ''"), 1U);
  expect_value(o.rupture_velocity_m_s, 2500);
}

TEST(Fsp, RejectsOtherUnits) {
  const Complaint c = refusal(single("avVr = 2.5 km/s", "avVr = 25 m/s"));
  EXPECT_EQ(c.line, 9U);
  EXPECT_EQ(c.key, "avVr");
  EXPECT_EQ(c.value, "25 m/s");
  EXPECT_EQ(c.allowed, "km/s");
}

TEST(Fsp, ReadsAFileWithDefectsAndWarns) {
  const Observation o = read(text_of("fsp_dirty"));
  EXPECT_EQ(o.name, "Lost Isle");
  expect_value(o.rupture_velocity_m_s, 3000);
  expect_value(o.slip, 1);
  expect_value(o.slip_velocity_m_s, 0.5);
  expect_value(o.shear_modulus, 33e9);
  EXPECT_FALSE(o.p_wave_speed || o.s_wave_speed || o.density || o.poisson_ratio);
  EXPECT_EQ(warnings_with(o, "no numbers, left out: 3"), 1U);
  EXPECT_EQ(warnings_with(o, "backwards, counted as written: 1"), 1U);
  EXPECT_EQ(warnings_with(o, "before the column names, ignored: 1"), 1U);
  EXPECT_EQ(o.warnings.size(), 3U);
}

TEST(Fsp, AcceptsAnyLineEndAndNoLastNewline) {
  for (const char* name : all_files) {
    const std::string text = text_of(name);
    const Observation unix_ends = read(text);
    std::string dos;
    for (const char c : text) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
    for (const std::string& other : {dos, text.substr(0, last_row(text).end)}) {
      const Observation o = read(other);
      EXPECT_EQ(o.name, unix_ends.name);
      EXPECT_EQ(o.warnings, unix_ends.warnings);
      expect_value(o.slip, unix_ends.slip->low);
    }
  }
}

TEST(Fsp, ReadsColumnNamesWithoutCommentSign) {
  const Observation o = read(single("%   LAT       LON ", "    LAT       LON "));
  expect_value(o.slip_velocity_m_s, 0.5);
  EXPECT_TRUE(o.warnings.empty());
}

TEST(Fsp, ConvertsNamesToValidText) {
  EXPECT_EQ(read(single("Northern   Nowhere", "S\xf8r\tland")).name, "S\xc3\xb8r land (Calif.)");
  EXPECT_EQ(read(single("Northern   Nowhere", "S\xc3\xb8rland\x01")).name, "S\xc3\xb8rland (Calif.)");
  EXPECT_EQ(read(single("Northern   Nowhere (Calif.) ", "")).name, "s1901NOWHERnobo");
  const Observation tag_only = read(single("% Event :", "% Evnt :"));
  EXPECT_EQ(tag_only.name, "s1901NOWHERnobo");
  EXPECT_EQ(tag_only.line, 4U);
}

TEST(Fsp, SurvivesVeryLongLines) {
  const std::string blanks(1 << 20, ' '), equals(1 << 20, '=');
  expect_value(read(single("Northern   ", "Northern" + blanks)).slip, 1);
  expect_value(read(single("% SVF  :", "% Invs : " + equals)).slip, 1);
  expect_value(read(single("% SVF  :", "% Invs : " + blanks + "Nx" + blanks + "=")).slip, 1);
}

TEST(Fsp, AcceptsOneWrongCountOfTwo) {
  EXPECT_EQ(warnings_with(read(single("Nsbfs =      6", "Nsbfs = 2")), "not Nsbfs = 2"), 1U);
  EXPECT_EQ(warnings_with(read(single("Nsbfs =      6", "Nsbfs = 60")), "not Nsbfs = 60"), 1U);
  EXPECT_EQ(warnings_with(read(single("Nx  =    3", "Nx  =   30")), "not Nx*Nz = 60"), 1U);
  EXPECT_TRUE(read(single("Nsbfs =      6", "Nsbfs = ")).warnings.empty());
  const std::string neither = edited(single("Nsbfs =      6", "Nsbfs = "), "Nx  =    3", "Nx  =  0");
  EXPECT_EQ(warnings_with(read(neither), "no Nsbfs"), 1U);
}

TEST(Fsp, RejectsARowCountBetweenTwoWrongCounts) {
  // There are six rows; one count is smaller and the other larger.
  const Complaint c = refusal(edited(single("Nsbfs =      6", "Nsbfs = 2"), "Nx  =    3", "Nx  = 4"));
  EXPECT_EQ(c.key, "Nx*Nz");
  EXPECT_EQ(c.value, "8");
  EXPECT_EQ(c.line, 48U);
  const std::string both_less = edited(single("Nsbfs =      6", "Nsbfs = 5"), "Nx  =    3", "Nx  = 1");
  expect_value(read(both_less).slip, 1);
}

TEST(Fsp, RequiresAPositiveMeanSlip) {
  // The six rows sum to -4 m, or to zero.
  for (const std::string slip : {"-8.000", "-4.000"}) {
    const Observation o = read(single("2.500     2.000", "2.500    " + slip));
    EXPECT_FALSE(o.slip || o.slip_velocity_m_s) << slip;
    EXPECT_EQ(warnings_with(o, "not positive"), 1U) << slip;
    EXPECT_EQ(warnings_with(o, "backwards, counted as written: 1"), 1U) << slip;
    expect_value(o.rupture_velocity_m_s, 2500);
    expect_value(o.rise_time, 2);
  }
}

TEST(Fsp, TakesTheLayerAtTheHypocentre) {
  const auto s_speed_at = [](const std::string& depth) {
    return read(single("DEP = 7.00", "DEP = " + depth)).s_wave_speed.value_or(0);
  };
  EXPECT_EQ(s_speed_at("0"), 1500);
  EXPECT_EQ(s_speed_at("3.99"), 1500);
  EXPECT_EQ(s_speed_at("4.00"), 3000);
  EXPECT_EQ(s_speed_at("700"), 4500);
  EXPECT_EQ(s_speed_at("999"), 3000);  // then HypZ, 5 km
  const std::string no_depth = edited(single("DEP = 7.00", "DEP = -99.0"), "HypZ =  5.00 km", "HypZ = 999 km");
  expect_no_elastic_constants(read(no_depth));
}

TEST(Fsp, ReadsDepthsAsBottomsIfTheyBeginBelowTheSurface) {
  const std::string text = single("%     0.00       3.00", "%     1.00       3.00");
  const Observation o = read(text);
  expect_value(o.s_wave_speed, 4500);  // 7 km: between the bottoms 4 km and 16 km
  EXPECT_EQ(warnings_with(o, "bottoms"), 1U);
  expect_value(read(edited(text, "DEP = 7.00", "DEP = 4.00")).s_wave_speed, 3000);
}

TEST(Fsp, TakesTheNextSolidLayerBelowWater) {
  const Observation o = read(text_of("fsp_srcmod_segments"));
  expect_value(o.p_wave_speed, 4000);
  expect_value(o.s_wave_speed, 2000);
  expect_value(o.shear_modulus, 8e9);
  EXPECT_EQ(warnings_with(o, "water"), 1U);
}

TEST(Fsp, IgnoresUnphysicalLayers) {
  const std::string layer = "4.00       6.00       3.00        2.50";
  for (const std::string bad :
       {"4.00       2.40       6.16        3.59", "4.00  4.24 3.00 2.50", "4.00  6.00 3.00 0.89",
        "4.00  6.00 3.00 8.10", "4.00 999 3.00 2.50", "4.00 -6 -3 2.5"}) {
    const Observation o = read(single(layer, bad));
    expect_no_elastic_constants(o);
    EXPECT_EQ(o.warnings.size(), 1U) << bad;
    expect_value(o.slip_velocity_m_s, 0.5);
  }
  expect_value(read(single(layer, "4.00  4.27 3.00 2.50")).s_wave_speed, 3000);
}

TEST(Fsp, IgnoresADamagedVelocityTable) {
  // A published file had lost these rows. Only their comment signs and the last layer were left.
  const Observation lost =
      read(single("%     0.00       3.00       1.50        2.00       70     35\n%     4.00", "% % 4.00"));
  expect_no_elastic_constants(lost);
  EXPECT_EQ(warnings_with(lost, "2 of the 3 layers"), 1U);
  const Observation disorder = read(single("%    16.00", "%     1.60"));
  expect_no_elastic_constants(disorder);
  EXPECT_EQ(warnings_with(disorder, "do not increase"), 1U);
}

TEST(Fsp, IgnoresAPlaceholderOfTheModulus) {
  for (const std::string bad : {"999", "0", "-99", "see the reference"}) {
    const Observation o = read(edited(text_of("fsp_dirty"), "%  3.30\n", "%  " + bad + "\n"));
    expect_no_elastic_constants(o);
    EXPECT_EQ(warnings_with(o, "no usable velocity table"), 1U) << bad;
  }
}

}  // namespace
}  // namespace slipfront::catalogue
