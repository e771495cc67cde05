#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "events/results/columns.hpp"
#include "events/results/evaluate.hpp"
#include "slipfront/events/catalogue/read.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;
using namespace slipfront::finite_fault;
using namespace slipfront::results;

constexpr const char* rows =
    "name,rupture_velocity,slip_velocity,contact_ratio\n"
    "known,3.0 +- 0.2 km/s,0.5 */ 1.2 m/s,0.01 +- 0.002\n"
    "trades off,3.0 +- 0.2 km/s,0.5 m/s,\n"
    "plain,3.0 km/s,,\n"
    "impossible,3.0 km/s,0.5 m/s,0.001\n"
    "too fast,9 km/s,,\n"
    "no number,x,,\n";

std::vector<Entry> entries() {
  std::vector<Entry> all;
  read_events(rows, "a.csv", [&](Entry&& entry) { all.push_back(std::move(entry)); });
  return all;
}

void expect_same(const EventResult& a, const EventResult& b) {
  for (const NumberColumn& c : number_columns({.pulse = true, .draws = 0})) {
    double x[3] = {}, y[3] = {};
    c.get(a, x);
    c.get(b, y);
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(x[i]), std::bit_cast<std::uint64_t>(y[i])) << c.name;
  }
  for (const TextColumn& c : text_columns(true)) EXPECT_EQ(c.get(a), c.get(b)) << c.name;
}

TEST(Saved, RestoresEveryBit) {
  const EvaluationOptions plan{.sampling = {.samples = 200, .draws = 7}};
  std::vector<EventResult> results;
  for (Entry& entry : entries()) results.push_back(evaluate(std::move(entry), {}, plan));
  FaultPulse pulse;  // needs not come from this event
  pulse.x = {1, 2};
  pulse.front_time = {0.5, std::nullopt};
  pulse.contact_ratio = 0.01;
  pulse.reached = 1;
  results[0].pulse = pulse;
  results[1].pulse.emplace().reason = "none";
  ASSERT_TRUE(results[0].posterior && results[1].posterior && !results[2].posterior);
  ASSERT_FALSE(results[1].posterior->trade_off.empty());
  ASSERT_EQ(results[0].posterior->repeated.size(), 7u);

  const std::string bytes = serialize(results);
  std::vector<SavedResult> found = deserialize(bytes);
  ASSERT_EQ(found.size(), results.size());
  EXPECT_EQ(found[0].pulse->front_time, pulse.front_time);
  EXPECT_EQ(found[1].posterior->trade_off.size(), results[1].posterior->trade_off.size());
  std::vector<EventResult> again;
  std::vector<Entry> same = entries();
  for (std::size_t i = 0; i < same.size(); ++i)
    again.push_back(evaluate(std::move(same[i]), {}, plan, std::move(found[i])));
  for (std::size_t i = 0; i < results.size(); ++i) expect_same(results[i], again[i]);
  EXPECT_EQ(serialize(again), bytes);
}

TEST(Saved, RejectsCutBytes) {
  std::vector<EventResult> results;
  for (Entry& entry : entries()) results.push_back(evaluate(std::move(entry), {}, {.sampling = {.samples = 50}}));
  const std::string bytes = serialize(results);
  EXPECT_THROW(deserialize(std::string_view(bytes).substr(0, bytes.size() - 1)), InputError);
  EXPECT_THROW(deserialize(std::string_view(bytes).substr(0, 20)), InputError);
  EXPECT_TRUE(deserialize(serialize({})).empty());
}

}  // namespace
