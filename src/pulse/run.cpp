#include "slipfront/pulse/run.hpp"

#include <chrono>
#include <cstdint>
#include <cstring>
#include <utility>

#include "slipfront/error.hpp"

namespace slipfront::pulse {
namespace {

/// Numbers as bytes in a row, little endian as every machine that this runs on.
class Writer {
 public:
  template <class T>
  void put(T value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put(const std::vector<double>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    text_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
};

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}
  template <class T>
  T get() {
    T value;
    take(&value, sizeof value);
    return value;
  }
  std::vector<double> vector() {
    const auto size = get<std::uint64_t>();
    if (size > text_.size() / sizeof(double)) refuse();
    std::vector<double> values(static_cast<std::size_t>(size));
    take(values.data(), values.size() * sizeof(double));
    return values;
  }
  void end() const {
    if (!text_.empty()) refuse();
  }

 private:
  [[noreturn]] static void refuse() {
    throw InputError({.key = "resume",
                      .problem = "the saved state is not that of a pulse run",
                      .allowed = "a file that slipfront pulse wrote"});
  }
  void take(void* to, std::size_t size) {
    if (size > text_.size()) refuse();
    if (size > 0) std::memcpy(to, text_.data(), size);
    text_.remove_prefix(size);
  }
  std::string_view text_;
};

constexpr std::uint64_t format = 1;

}  // namespace

Run::Run(Problem problem, Schedule schedule)
    : schedule_(std::move(schedule)), solver_(std::move(problem)), left_front_(solver_) {}

Run::Run(Problem problem, Schedule schedule, std::string_view saved, std::vector<Snapshot> snapshots)
    : Run(std::move(problem), std::move(schedule)) {
  Reader reader(saved);
  if (reader.get<std::uint64_t>() != format || snapshots.size() > schedule_.times.size())
    throw InputError({.key = "resume",
                      .problem = "the saved state is of another version or scenario",
                      .allowed = "a file of this version and scenario"});
  Cells cells;
  cells.time = reader.get<double>();
  cells.steps = static_cast<long>(reader.get<std::int64_t>());
  cells.step = reader.get<double>();
  left_front_.restore(reader.get<double>());
  cells.y = reader.vector();
  cells.s = reader.vector();
  reader.end();
  solver_.restore(std::move(cells));
  snapshots_ = std::move(snapshots);
}

std::string Run::saved() const {
  Writer writer;
  const Cells& cells = solver_.cells();
  writer.put(format);
  writer.put(cells.time);
  writer.put(static_cast<std::int64_t>(cells.steps));
  writer.put(cells.step);
  writer.put(left_front_.position());
  writer.put(cells.y);
  writer.put(cells.s);
  return std::move(writer).text();
}

void Run::take() {
  snapshots_.push_back(observe(solver_, schedule_.x_edges, left_front_.position(), schedule_.threshold));
}

bool Run::go(const std::function<bool()>& interrupted) {
  while (!finished()) {
    const double target = schedule_.times[snapshots_.size()];
    double before = solver_.cells().time;
    const auto after_step = [&] {
      left_front_.advance(solver_, solver_.cells().time - before);
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
