#include "slipfront/text/output/quantities.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "runs/record/run_file.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/lattice/plane/quantities.hpp"
#include "slipfront/text/output/slip_event.hpp"
#include "slipfront/theory/medium/si_units.hpp"

namespace {

using slipfront::Description;
using slipfront::output::Snapshot;
namespace output = slipfront::output;
namespace plane = slipfront::plane;

/// The descriptions in lists of declarations.
std::vector<Description> descriptions_in(const auto&... lists) {
  std::vector<Description> all;
  const auto add = [&](const auto& list) {
    for (const auto& one : list) all.push_back(one.about);
  };
  (add(lists), ...);
  return all;
}

void expect_different_names(const std::vector<Description>& all) {
  std::set<std::string_view> names;
  for (const Description& about : all) EXPECT_TRUE(names.insert(about.name).second) << about.name;
}

TEST(DeclaredNumbers, EachScalarHasAMemberOfItsOwn) {
  Snapshot snapshot{};
  double value = 0;
  for (const output::Scalar& scalar : output::scalars()) scalar.set(snapshot, ++value);
  value = 0;
  for (const output::Scalar& scalar : output::scalars()) EXPECT_EQ(scalar.get(snapshot), ++value) << scalar.about.name;
}

TEST(DeclaredNumbers, NamesInOneFileDiffer) {
  expect_different_names(descriptions_in(output::scalars(), slipfront::record::field_variables(),
                                         output::slip_event_columns(), output::front_columns()));
  expect_different_names(descriptions_in(output::scalars(), slipfront::pulse::quantities()));
  expect_different_names(descriptions_in(output::scalars(), slipfront::chain::quantities()));
  expect_different_names(
      descriptions_in(plane::field_arrays(), plane::map_arrays(), plane::series_numbers(), plane::line_arrays()));
}

TEST(DeclaredNumbers, UnitsAreExpressionsOfTheConstants) {
  constexpr slipfront::medium::SymbolValues values{.mu = 3e10, .nu = 0.25, .A = 0.01, .b = 1e-3, .c = 3e3};
  for (const Description& about : descriptions_in(
           output::scalars(), slipfront::record::field_variables(), output::slip_event_columns(),
           output::front_columns(), slipfront::pulse::quantities(), slipfront::chain::quantities(), plane::quantities(),
           plane::field_arrays(), plane::map_arrays(), plane::series_numbers(), plane::line_arrays())) {
    EXPECT_FALSE(about.long_name.empty()) << about.name;
    if (about.dimensional_unit.empty()) continue;
    EXPECT_NO_THROW(slipfront::medium::in_si(about.dimensional_unit, values)) << about.name;
  }
}

}  // namespace
