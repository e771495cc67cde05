#include "foundation/math/constants.hpp"
#include "slipfront/chain/run.hpp"

namespace slipfront::chain {
namespace {

using output::EventSeries;
using output::Value;

const Grid& grid_of(const Report& e) { return e.run.chain().problem().grid; }

double site_updates_per_second(const Report& e) {
  const double updates = static_cast<double>(grid_of(e).sites) * static_cast<double>(e.spent.steps);
  return e.spent.stepping > 0 ? updates / e.spent.stepping : 0;
}

bool is_loaded(const Report& e) { return e.run.chain().problem().loading.acts(); }

constexpr std::string_view few_events = "there are fewer than two slip events", no_event = "no slip event is complete";

constexpr output::Quantity<Report> of_run[] = {
    {output::scale_factor, [](const Report& e) -> Value { return e.run.scale(); }},
    {output::slip_window, [](const Report& e) -> Value { return e.run.window(); }},
    {output::velocity_window, [](const Report& e) -> Value { return e.averages.width; }},
    {{"event_count", "number of slip events", "", "Eq. 1", "no springs load the chain"},
     [](const Report& e) -> Value {
       return is_loaded(e) ? static_cast<double>(output::series_of(e.run.events()).count) : none;
     }},
    {{"event_recurrence_time", "median time between onsets of slip events", "b / (c A)", "Eq. 1", few_events},
     [](const Report& e) -> Value { return output::series_of(e.run.events()).recurrence_time; }},
    {{"event_median_stress_drop", "median stress drop of slip events", "", "Eq. 1", no_event},
     [](const Report& e) -> Value { return output::series_of(e.run.events()).stress_drop; },
     output::Kind::result,
     [](const Report& e) { return output::unit_of_load(e.run.chain().problem().loading.where != Pulled::everywhere); }},
    {{"event_median_peak_velocity", "median peak velocity of slip events", "c A / pi", "Eq. 1", no_event},
     [](const Report& e) -> Value { return output::series_of(e.run.events()).peak_velocity; }},
    {{"dislocations", "number of dislocations at the end", "", "Eq. 1"},
     [](const Report& e) -> Value { return e.balance.dislocations; }},
    {{"energy_drift", "relative error of the balance of energy and work since t = 0", "", "Eq. 1"},
     [](const Report& e) -> Value { return e.balance.energy_drift; }},
    {{"charge_error", "dislocations that left through the ends; 0 if these are fixed or periodic", "", "Eq. 1"},
     [](const Report& e) -> Value { return e.balance.charge_error; }},
    {{"sites", "number of sites", "", ""},
     [](const Report& e) -> Value { return static_cast<long>(grid_of(e).sites); }},
    {{"spacing", "spacing of the sites, in the chain's own x", "", ""},
     [](const Report& e) -> Value { return grid_of(e).spacing; }},
    {output::step_count, [](const Report& e) -> Value { return e.run.chain().steps(); }},
    {{"ranks", "number of processes", "", ""},
     [](const Report& e) -> Value { return static_cast<long>(e.spent.ranks); },
     output::Kind::of_machine},
    {{"threads", "threads of each rank", "", ""},
     [](const Report& e) -> Value { return static_cast<long>(e.spent.threads); },
     output::Kind::of_machine},
    {{"site_updates_per_second", "site updates per second, including output", "", ""},
     [](const Report& e) -> Value { return site_updates_per_second(e); },
     output::Kind::of_machine},
    {output::wall_time, [](const Report& e) -> Value { return e.spent.wall; }, output::Kind::of_machine},
};

}  // namespace

std::span<const output::Quantity<Report>> quantities() { return of_run; }

}  // namespace slipfront::chain
