#include "runs/record/events/event_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "events/results/columns.hpp"
#include "events/results/evaluate.hpp"
#include "runs/record/arrays.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "runs/record/run_file.hpp"
#include "slipfront/error.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "system/files/whole_file.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;
using namespace slipfront::results;
using namespace slipfront::record;

const EventMetadata event_metadata = {
    .version = "1", .command_line = "slipfront event a.csv", .settings = {{"seed", "1"}}};

std::vector<EventResult> results() {
  std::vector<EventResult> all;
  read_events(
      "name,rupture_velocity,slip_velocity,contact_ratio\n"
      "\"M\303\251"
      "xico, 1985\",3.0 +- 0.2 km/s,0.5 m/s,0.01 +- 0.002\n"
      "slow,10 km/day,,\n"
      "bad \377,x,,\n",
      "a.csv", [&](Entry&& entry) { all.push_back(evaluate(std::move(entry), {}, {.sampling = {.samples = 100}})); });
  return all;
}

std::vector<Decade> population_of(const std::vector<EventResult>& all) {
  Population population;
  for (const EventResult& r : all)
    if (const auto member = member_of(r)) population.add(*member);
  return population.decades();
}

class EventFile : public testing::Test {
 protected:
  void write(bool finished = true) { write_events(path, event_metadata, all, population_of(all), finished); }

  TemporaryFolder folder;
  const std::string path = folder / "a.nc";
  const std::vector<EventResult> all = results();
};

TEST_F(EventFile, HoldsWhatIsNeededToResume) {
  write(false);
  EXPECT_EQ(read_events_done(path, event_metadata), serialize(all));
  EXPECT_EQ(deserialize(read_events_done(path, event_metadata)).size(), 3u);
  const std::string first = read_text(path);
  write(false);
  EXPECT_EQ(read_text(path), first);
  write_events(path, event_metadata, {}, {}, false);  // nothing done yet
  EXPECT_TRUE(deserialize(read_events_done(path, event_metadata)).empty());
}

TEST_F(EventFile, HoldsTheColumnsAndThePopulation) {
  write();
  const std::string bytes = read_text(path);
  const netcdf::Reader file(path, bytes, bytes.size());
  EXPECT_EQ(file.number("finished"), 1);
  EXPECT_EQ(file.text("seed"), "1");
  const auto stress = file.reals(file.find("stress").value());
  ASSERT_EQ(stress.size(), 3u);
  EXPECT_EQ(stress[0], all[0].estimate->stress->value);
  EXPECT_TRUE(std::isnan(stress[2]));
  const auto interval = file.reals(file.find("stress_interval").value());
  ASSERT_EQ(interval.size(), 6u);
  EXPECT_EQ(interval[1], all[0].estimate->stress->interval->high);
  const auto quantiles = file.reals(file.find("posterior_contact_ratio").value());
  ASSERT_EQ(quantiles.size(), 9u);
  EXPECT_EQ(quantiles[1], all[0].posterior->contact_ratio->median);
  EXPECT_EQ(file.find("name")->shape, std::vector<std::size_t>{3});
  const auto decades = file.reals(file.find("decade").value());
  ASSERT_EQ(decades.size(), 5u);  // 2e-5 ... 0.6 c
  EXPECT_EQ(file.reals(file.find("population_events").value()), (std::vector<double>{1, 0, 0, 0, 1}));
  EXPECT_EQ(file.find("line_stress")->shape, std::vector<std::size_t>{101});
}

TEST_F(EventFile, RejectsAFileOfAnotherCatalogue) {
  write(false);
  EventMetadata other = event_metadata;
  other.settings[0].second = "2";
  const std::string says = message_of<InputError>([&] { read_events_done(path, other); });
  EXPECT_NE(says.find("another seed"), std::string::npos) << says;
  EXPECT_NE(says.find("'2'"), std::string::npos) << says;
  other = event_metadata;
  other.version = "2";
  EXPECT_THROW(read_events_done(path, other), InputError);
  EXPECT_THROW(read_events_done(folder / "none.nc", event_metadata), FileError);
  EXPECT_THROW(read_checkpoint(path), FileError);
  write_run(path, {.format = pulse_format, .title = {}, .scenario_text = {}, .version = "1", .command_line = {}}, {},
            "", false);
  EXPECT_THROW(read_events_done(path, event_metadata), FileError);
}

TEST_F(EventFile, RejectsDamage) {
  write(false);
  const std::string whole = read_text(path);
  for (const std::size_t at : {std::size_t{100}, whole.size() / 2, whole.size() - 30}) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    write_text(path, damaged);
    EXPECT_THROW(read_events_done(path, event_metadata), FileError);
    write_text(path, whole.substr(0, at));
    EXPECT_THROW(read_events_done(path, event_metadata), FileError);
  }
}

TEST(ChecksumOfInputs, DependsOnNamesContentsAndOrder) {
  const auto one = checksum_of_inputs("", "a", "b");
  EXPECT_NE(one, checksum_of_inputs("", "ab", ""));
  EXPECT_NE(checksum_of_inputs(one, "c", "d"), checksum_of_inputs(checksum_of_inputs("", "c", "d"), "a", "b"));
  EXPECT_EQ(one, checksum_of_inputs("", "a", "b"));
  EXPECT_EQ(one.size(), 16u);
}

}  // namespace
