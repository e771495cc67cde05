#include "slipfront/pulse/run.hpp"

#include <chrono>
#include <cstdint>
#include <utility>

#include "../bytes.hpp"
#include "slipfront/error.hpp"

namespace slipfront::pulse {
namespace {

constexpr std::uint64_t format = 3;

}  // namespace

Run::Run(Problem problem, Schedule schedule)
    : schedule_(std::move(schedule)), solver_(std::move(problem)), trailing_front_(solver_) {}

Run::Run(Problem problem, Schedule schedule, std::string_view saved, std::vector<Snapshot> snapshots)
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
  trailing_front_.restore(reader.get<double>());
  cells.y = reader.vector();
  cells.s = reader.vector();
  cells.charge = reader.vector();
  cells.face_momentum = reader.vector();
  cells.entered_left = reader.get<double>();
  cells.entered_right = reader.get<double>();
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
  writer.put(trailing_front_.position());
  writer.put(cells.y);
  writer.put(cells.s);
  writer.put(cells.charge);
  writer.put(cells.face_momentum);
  writer.put(cells.entered_left);
  writer.put(cells.entered_right);
  return std::move(writer).text();
}

void Run::take() { snapshots_.push_back(observe(solver_, schedule_.x_edges, trailing_front_, schedule_.threshold)); }

bool Run::go(const std::function<bool()>& interrupted) {
  while (!finished()) {
    const double target = schedule_.times[snapshots_.size()];
    double before = solver_.cells().time;
    const auto after_step = [&] {
      trailing_front_.advance(solver_, solver_.cells().time - before);
      before = solver_.cells().time;
      return interrupted && interrupted();
    };
    const auto begun = std::chrono::steady_clock::now();
    const bool reached = solver_.advance_to(target, after_step);
    stepping_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    if (!reached) return false;
    take();
  }
  return true;
}

}  // namespace slipfront::pulse
