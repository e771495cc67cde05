#include "slipfront/pulse/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <utility>

#include "../bytes.hpp"
#include "../digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::pulse {
namespace {

constexpr std::uint64_t format = 4;

}  // namespace

Run::Run(Problem problem, output::Schedule schedule)
    : schedule_(std::move(schedule)), solver_(std::move(problem)), trailing_characteristic_(solver_) {
  const output::Energy energy = energy_of(solver_);
  first_energy_ = energy.elastic + energy.kinetic;
}

Run::Run(Problem problem, output::Schedule schedule, std::string_view saved, std::vector<output::Snapshot> snapshots)
    : Run(std::move(problem), std::move(schedule)) {
  bytes::Reader reader(saved);
  if (reader.get<std::uint64_t>() != format || snapshots.size() > schedule_.times.size())
    throw InputError({.key = "resume",
                      .problem = "the saved state is of another version or scenario",
                      .allowed = "a file of this version and scenario"});
  Cells cells;
  cells.time = reader.get<double>();
  cells.steps = static_cast<long>(reader.get<std::int64_t>());
  cells.step = reader.get<double>();
  trailing_characteristic_.restore(reader.get<double>());
  cells.y = reader.vector();
  cells.s = reader.vector();
  cells.charge = reader.vector();
  cells.face_momentum = reader.vector();
  cells.entered_left = reader.get<double>();
  cells.entered_right = reader.get<double>();
  cells.crossing_time = reader.get<double>();
  cells.crossing_position = reader.get<double>();
  output::SampledIntegral& slip = slip_;
  for (double* value : {&slip.time, &slip.velocity, &slip.integral, &slip_size_, &slip.early_time, &slip.early_velocity,
                        &slip.coarse_integral, &slip.spread, &slip_doubt_})
    *value = reader.get<double>();
  slip.samples = static_cast<long>(reader.get<std::int64_t>());
  reader.end();
  solver_.restore(std::move(cells));
  snapshots_ = std::move(snapshots);
}

std::string Run::saved() const {
  bytes::Writer writer;
  const Cells& cells = solver_.cells();
  writer.put(format);
  writer.put(cells.time);
  writer.put(static_cast<std::int64_t>(cells.steps));
  writer.put(cells.step);
  writer.put(trailing_characteristic_.position());
  writer.put(cells.y);
  writer.put(cells.s);
  writer.put(cells.charge);
  writer.put(cells.face_momentum);
  writer.put(cells.entered_left);
  writer.put(cells.entered_right);
  writer.put(cells.crossing_time);
  writer.put(cells.crossing_position);
  const output::SampledIntegral& slip = slip_;
  for (const double value : {slip.time, slip.velocity, slip.integral, slip_size_, slip.early_time, slip.early_velocity,
                             slip.coarse_integral, slip.spread, slip_doubt_})
    writer.put(value);
  writer.put(static_cast<std::int64_t>(slip.samples));
  return std::move(writer).text();
}

void Run::take() {
  output::Snapshot s = observe(solver_, schedule_.x_edges, trailing_characteristic_, schedule_.threshold);
  output::Energy& e = s.energy;
  e.shocks = first_energy_ + e.supplied + e.through_ends - e.dissipated - e.elastic - e.kinetic;
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
      return interrupted && interrupted();
    };
    const auto begun = std::chrono::steady_clock::now();
    const bool reached = solver_.advance_to(target, after_step);
    stepping_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    if (!reached) return false;
    take();
  }
  final_findings_ = findings();
  if (final_findings_->wrong_results())
    throw NumericsError("t = " + digits(solver_.cells().time) + ": " + final_findings_->worst);
  return true;
}

}  // namespace slipfront::pulse
