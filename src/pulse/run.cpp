#include "slipfront/pulse/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "foundation/bytes.hpp"
#include "foundation/clock.hpp"
#include "foundation/text/digits.hpp"
#include "output/further_scalars.hpp"
#include "slipfront/error.hpp"

namespace slipfront::pulse {
namespace {

constexpr std::uint64_t format = 6;

[[noreturn]] void refuse_saved() {
  throw InputError({.key = "resume",
                    .problem = "the saved state is of another version or scenario",
                    .allowed = "a file of this version and scenario"});
}

/// What a saved run holds, in its order.
void put(bytes::Writer& writer, std::string_view name, const std::vector<double>& values) {
  writer.put_text(name);
  writer.put(values);
}
std::vector<double> get(bytes::Reader& reader, std::string_view name) {
  if (reader.text() != name) refuse_saved();
  return reader.vector();
}
double get_number(bytes::Reader& reader, std::string_view name) {
  const std::vector<double> values = get(reader, name);
  if (values.size() != 1) refuse_saved();
  return values[0];
}

/// The names of what places remember, in their order.
std::string memory_name(const friction::Friction& friction) {
  std::string names = "memory:";
  for (const friction::StateVariable& variable : friction.definition().state) names += " " + std::string(variable.name);
  return names;
}

void save(const Cells& cells, const friction::Friction& friction, bytes::Writer& writer) {
  const ConstValues values = cells.values();
  std::vector<double> width, momentum;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    width.push_back(values.width(i));
    momentum.push_back(values.momentum(i));
  }
  put(writer, "time", {cells.time});
  put(writer, "steps", {static_cast<double>(cells.steps)});
  put(writer, "step", {cells.step});
  put(writer, "charge", cells.charge);
  put(writer, "width", width);
  put(writer, "momentum", momentum);
  put(writer, "left_edge", {values.left_edge()});
  put(writer, "dissipated", {values.dissipated()});
  put(writer, "supplied", {values.supplied()});
  put(writer, "through_ends", {values.through_ends()});
  put(writer, "tanh_psi", cells.s);
  put(writer, "face_momentum", cells.face_momentum);
  put(writer, "entered_left", {cells.entered_left});
  put(writer, "entered_right", {cells.entered_right});
  put(writer, "crossing_time", {cells.crossing_time});
  put(writer, "crossing_position", {cells.crossing_position});
  put(writer, memory_name(friction), cells.memory);
}

Cells saved_cells(const friction::Friction& friction, bytes::Reader& reader) {
  Cells cells;
  cells.time = get_number(reader, "time");
  const double steps = get_number(reader, "steps");
  if (!(steps >= 0 && steps < 9e15)) refuse_saved();
  cells.steps = static_cast<long>(steps);
  cells.step = get_number(reader, "step");
  cells.charge = get(reader, "charge");
  const std::vector<double> width = get(reader, "width"), momentum = get(reader, "momentum");
  if (width.size() != cells.size() || momentum.size() != cells.size()) refuse_saved();
  cells.unknowns.resize(Values::size(cells.size()));
  const Values values = cells.values();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    values.width(i) = width[i];
    values.momentum(i) = momentum[i];
  }
  values.left_edge() = get_number(reader, "left_edge");
  values.dissipated() = get_number(reader, "dissipated");
  values.supplied() = get_number(reader, "supplied");
  values.through_ends() = get_number(reader, "through_ends");
  cells.s = get(reader, "tanh_psi");
  cells.face_momentum = get(reader, "face_momentum");
  cells.entered_left = get_number(reader, "entered_left");
  cells.entered_right = get_number(reader, "entered_right");
  cells.crossing_time = get_number(reader, "crossing_time");
  cells.crossing_position = get_number(reader, "crossing_position");
  cells.memory = get(reader, memory_name(friction));
  return cells;
}

/// A step ends on each output time, and the one before it is shortened.
double expected_steps(const Solver& start, const output::Schedule& schedule) {
  return start.expected_steps(schedule.times.back()) + 2 * static_cast<double>(schedule.times.size());
}

}  // namespace

Run::Run(Problem problem, output::Schedule schedule)
    : schedule_(std::move(schedule)),
      solver_(std::move(problem)),
      budget_(expected_steps(solver_, schedule_), schedule_.times.back()),
      trailing_characteristic_(solver_),
      first_energy_(stored_energy(solver_)) {}

Run::Run(Problem problem, output::Schedule schedule, std::string_view saved, std::vector<output::Snapshot> snapshots)
    : Run(std::move(problem), std::move(schedule)) {
  bytes::Reader reader(saved);
  if (reader.get<std::uint64_t>() != format || snapshots.size() > schedule_.times.size()) refuse_saved();
  Cells cells = saved_cells(solver_.problem().friction, reader);
  const double trailing_characteristic = get_number(reader, "trailing_characteristic");
  output::SampledIntegral& slip = slip_;
  for (double* value : {&slip.time, &slip.velocity, &slip.integral, &slip_size_, &slip.early_time, &slip.early_velocity,
                        &slip.coarse_integral, &slip.spread, &slip_doubt_})
    *value = reader.get<double>();
  slip.samples = static_cast<long>(reader.get<std::int64_t>());
  reader.end();
  solver_.restore(std::move(cells));
  trailing_characteristic_.restore(solver_, trailing_characteristic);
  snapshots_ = std::move(snapshots);
}

std::string Run::saved() const {
  bytes::Writer writer;
  writer.put(format);
  save(solver_.cells(), solver_.problem().friction, writer);
  put(writer, "trailing_characteristic", {trailing_characteristic_.position()});
  const output::SampledIntegral& slip = slip_;
  for (const double value : {slip.time, slip.velocity, slip.integral, slip_size_, slip.early_time, slip.early_velocity,
                             slip.coarse_integral, slip.spread, slip_doubt_})
    writer.put(value);
  writer.put(static_cast<std::int64_t>(slip.samples));
  return std::move(writer).text();
}

void Run::take() {
  output::Snapshot s = observe(solver_, schedule_.x_edges, trailing_characteristic_, schedule_.threshold);
  const StoredEnergy stored = stored_energy(solver_);
  output::Energy& e = s.energy;
  const double released =
      (first_energy_.isolated - stored.isolated + e.through_ends) + first_energy_.interaction - stored.interaction;
  e.shocks = released + first_energy_.kinetic + e.supplied - e.dissipated - e.kinetic;
  output::add_further_scalars(s, schedule_);
  snapshots_.push_back(std::move(s));
}

namespace {

/// By how much the slip velocity at x may be wrong: what the curve between the centre and the face beside it adds to a
/// straight line, and a hundredth of what W changes by between them. Where a pulse is narrower than a cell, the cells
/// do not resolve it.
double unresolved_at(const Solver::View& v, double x, double W) {
  const auto right = std::upper_bound(v.faces.begin() + 1, v.faces.end() - 1, x);
  const auto cell = static_cast<std::size_t>(right - v.faces.begin() - 1);
  if (v.states[cell].empty()) return 0;
  constexpr double interpolated = 0.01;
  const std::size_t face = x < v.centres[cell] ? cell : cell + 1;
  const double at_face = averages_of(v, v.face_states[face], v.faces[face]).W;
  const double at_centre = averages_of(v, v.states[cell], v.centres[cell]).W;
  const double share = (x - v.centres[cell]) / (v.faces[face] - v.centres[cell]);
  return std::fabs(W - std::lerp(at_centre, at_face, share)) + interpolated * std::fabs(at_face - at_centre);
}

}  // namespace

void Run::sample() {
  const Solver::View v = solver_.view(false);
  const double time = solver_.cells().time, velocity = averages_of(v, state_at(v, 0), 0).W;
  const double elapsed = time - slip_.time;
  slip_size_ += elapsed * (std::fabs(velocity) + std::fabs(slip_.velocity)) / 2;
  slip_doubt_ += elapsed * unresolved_at(v, 0, velocity);
  slip_.add(time, velocity);
}

void Run::refuse_more_steps() const {
  const Cells& cells = solver_.cells();
  throw budget_.error(cells.time, cells.steps, solver_.reason_of_short_steps(),
                      "fewer pulse.cells, an earlier time.end or slipfront chain may help");
}

bool Run::go(const std::function<bool()>& interrupted) {
  while (!finished()) {
    const double target = schedule_.times[snapshots_.size()];
    double before = solver_.cells().time;
    const auto after_step = [&] {
      trailing_characteristic_.advance(solver_, solver_.cells().time - before);
      before = solver_.cells().time;
      // An implicit step costs as much as ten samples, an explicit one as a few.
      const Cells& cells = solver_.cells();
      const bool begins = cells.steps < 64, is_explicit = cells.face_momentum.empty();
      if (cells.steps % (is_explicit ? begins ? 4 : 16 : begins ? 1 : 2) == 0) sample();
      if (budget_.exhausted(cells.steps)) refuse_more_steps();
      return interrupted && interrupted();
    };
    const auto begun = Clock::now();
    const bool reached = solver_.advance_to(target, after_step);
    stepping_seconds_ += seconds_since(begun);
    if (!reached) return false;
    take();
  }
  final_findings_ = findings();
  if (final_findings_->wrong_results())
    throw NumericsError("t = " + digits(solver_.cells().time) + ": " + final_findings_->worst);
  return true;
}

}  // namespace slipfront::pulse
