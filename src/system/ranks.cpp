#include "system/ranks.hpp"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include "slipfront/error.hpp"

#ifdef SLIPFRONT_MPI
#include <mpi.h>

#include <climits>
#include <cstdint>
#endif

namespace slipfront {
namespace {

void copy(std::span<const double> from, std::span<double> to) { std::copy(from.begin(), from.end(), to.begin()); }

/// One rank is its own neighbour around a ring.
void exchange_alone(std::span<const double> to_left, std::span<const double> to_right, std::span<double> from_left,
                    std::span<double> from_right, bool around) {
  if (!around) return;
  copy(to_right, from_left);
  copy(to_left, from_right);
}

}  // namespace

const Ranks& Ranks::single() {
  static const Ranks one;
  return one;
}

int Ranks::failed(int code, const std::function<void()>& say) const {
  if (size_ == 1 || !agreed_ || rank_ == 0) say();
#ifdef SLIPFRONT_MPI
  if (size_ > 1 && !agreed_) MPI_Abort(MPI_COMM_WORLD, code);
#endif
  return code_of(code);
}

#ifdef SLIPFRONT_MPI

bool Ranks::available() { return true; }

Ranks Ranks::of_mpirun() {
  bool launched = false;  // a program that nobody launched does not pay for the start of MPI
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
    launched = launched || std::getenv(name) != nullptr;
  int running = 0;
  MPI_Initialized(&running);
  if (!launched && running == 0) return {};
  if (running == 0) {
    int threads = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &threads);
  }
  int rank = 0, size = 1, here = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &here);
  MPI_Comm_free(&machine);
  return {rank, size, static_cast<double>(here) / size, running == 0};
}

Ranks::~Ranks() {
  if (!ends_mpi_) return;
  if (size_ > 1 && !agreed_ && std::uncaught_exceptions() > 0) MPI_Abort(MPI_COMM_WORLD, 4);
  MPI_Finalize();
}

namespace {

/// The lines after the first one, as errors.
std::vector<Complaint> other_lines(const std::string& text) {
  std::vector<Complaint> lines;
  for (std::size_t end = text.find('\n'); end != std::string::npos;) {
    const std::size_t begin = end + 1;
    end = text.find('\n', begin);
    lines.push_back({.problem = text.substr(begin, end - begin)});
  }
  return lines;
}

}  // namespace

void Ranks::together(const std::function<void()>& task) const {
  if (size_ == 1) return task();
  agreed_ = false;
  enum : int { input, file, numerics } kind = numerics;
  std::string text;
  bool threw = true;
  try {
    task();
    threw = false;
  } catch (const InputError& error) {
    kind = input;
    text = error.what();
  } catch (const FileError& error) {
    kind = file;
    text = error.what();
  } catch (const std::bad_alloc&) {
    text = "out of memory";
  } catch (const std::exception& error) {
    text = error.what();
  }
  int first = threw ? rank_ : size_;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (first == size_) return;
  int head[2] = {kind, static_cast<int>(text.size())};
  MPI_Bcast(head, 2, MPI_INT, first, MPI_COMM_WORLD);
  text.resize(static_cast<std::size_t>(head[1]));
  MPI_Bcast(text.data(), head[1], MPI_CHAR, first, MPI_COMM_WORLD);
  agreed_ = true;
  if (head[0] == input) throw InputError({.problem = text.substr(0, text.find('\n'))}, other_lines(text));
  if (head[0] == file) throw FileError(text);
  throw NumericsError(text);
}

void Ranks::require_same(const char* what, std::string_view text) const {
  if (size_ == 1) return;
  std::uint64_t sum = 0xcbf29ce484222325ULL;  // FNV-1a
  for (const char c : text) sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  std::uint64_t ends[2] = {sum, ~sum};  // the greatest, and the complement of the least
  MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD);
  agreed_ = true;
  if (ends[0] != ~ends[1])
    throw InputError({.key = what, .problem = "not the same on all ranks", .allowed = "the same for each process"});
}

bool Ranks::any(bool mine) const {
  agreed_ = false;
  int some = mine ? 1 : 0;
  if (size_ > 1) MPI_Allreduce(MPI_IN_PLACE, &some, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return some != 0;
}

double Ranks::largest(double mine) const {
  agreed_ = false;
  if (size_ > 1) MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return mine;
}

namespace {

/// Counts of all ranks, and where the numbers of each begin.
struct Layout {
  std::vector<int> counts, begins;
  std::size_t all = 0;
};

Layout layout_of(std::size_t mine, int ranks) {
  Layout l{std::vector<int>(static_cast<std::size_t>(ranks)), std::vector<int>(static_cast<std::size_t>(ranks))};
  const int count = mine > INT_MAX ? -1 : static_cast<int>(mine);
  MPI_Allgather(&count, 1, MPI_INT, l.counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  bool fits = true;
  for (std::size_t r = 0; r < l.counts.size(); ++r) {
    fits = fits && l.counts[r] >= 0 && l.all <= INT_MAX;
    l.begins[r] = static_cast<int>(l.all);
    l.all += static_cast<std::size_t>(l.counts[r]);
  }
  if (!fits || l.all > INT_MAX) throw NumericsError("too many numbers for one message between ranks");
  return l;
}

// Tags of messages. Two ranks around a ring are each other's neighbour twice.
constexpr int leftwards = 1, rightwards = 2, handed_on = 3;

}  // namespace

std::vector<double> Ranks::joined(const std::vector<double>& mine) const {
  if (size_ == 1) return mine;
  const Layout l = layout_of(mine.size(), size_);
  std::vector<double> all(l.all);
  MPI_Allgatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, all.data(), l.counts.data(), l.begins.data(),
                 MPI_DOUBLE, MPI_COMM_WORLD);
  return all;
}

void Ranks::join(std::span<const double> mine, std::span<double> all) const {
  if (size_ == 1) return copy(mine, all);
  const Layout l = layout_of(mine.size(), size_);
  if (l.all != all.size()) throw NumericsError("numbers of another count than expected");
  MPI_Allgatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, all.data(), l.counts.data(), l.begins.data(),
                 MPI_DOUBLE, MPI_COMM_WORLD);
}

std::vector<double> Ranks::joined_at_first(const std::vector<double>& mine) const {
  if (size_ == 1) return mine;
  const Layout l = layout_of(mine.size(), size_);
  std::vector<double> all(rank_ == 0 ? l.all : 0);
  MPI_Gatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, all.data(), l.counts.data(), l.begins.data(),
              MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return all;
}

void Ranks::from_first(std::span<double> numbers) const {
  if (size_ > 1) MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
}

void Ranks::send(Neighbour to, std::span<const double> numbers) const {
  const int other = to == Neighbour::next ? rank_ + 1 : rank_ - 1;
  if (other < 0 || other == size_) return;
  MPI_Send(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, other, handed_on, MPI_COMM_WORLD);
}

void Ranks::receive(Neighbour from, std::span<double> numbers) const {
  const int other = from == Neighbour::next ? rank_ + 1 : rank_ - 1;
  if (other < 0 || other == size_) return;
  MPI_Recv(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, other, handed_on, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
}

void Ranks::exchange(std::span<const double> to_left, std::span<const double> to_right, std::span<double> from_left,
                     std::span<double> from_right, bool around) const {
  if (size_ == 1) return exchange_alone(to_left, to_right, from_left, from_right, around);
  const int before = rank_ > 0 ? rank_ - 1 : around ? size_ - 1 : MPI_PROC_NULL;
  const int behind = rank_ + 1 < size_ ? rank_ + 1 : around ? 0 : MPI_PROC_NULL;
  const auto count = [](auto numbers) { return static_cast<int>(numbers.size()); };
  MPI_Sendrecv(to_left.data(), count(to_left), MPI_DOUBLE, before, leftwards, from_right.data(), count(from_right),
               MPI_DOUBLE, behind, leftwards, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  MPI_Sendrecv(to_right.data(), count(to_right), MPI_DOUBLE, behind, rightwards, from_left.data(), count(from_left),
               MPI_DOUBLE, before, rightwards, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

#else  // one rank

bool Ranks::available() { return false; }

Ranks Ranks::of_mpirun() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* processes = std::getenv(name); processes != nullptr && std::atoi(processes) > 1)
      throw InputError({.key = "mpirun",
                        .value = processes,
                        .problem = "several processes, but this slipfront was built without MPI",
                        .allowed = "1, or a build with SLIPFRONT_MPI"});
  return {};
}

Ranks::~Ranks() = default;
void Ranks::together(const std::function<void()>& task) const { task(); }
void Ranks::require_same(const char*, std::string_view) const {}
bool Ranks::any(bool mine) const { return mine; }
double Ranks::largest(double mine) const { return mine; }
void Ranks::join(std::span<const double> mine, std::span<double> all) const { copy(mine, all); }
void Ranks::from_first(std::span<double>) const {}
void Ranks::send(Neighbour, std::span<const double>) const {}
void Ranks::receive(Neighbour, std::span<double>) const {}
std::vector<double> Ranks::joined(const std::vector<double>& mine) const { return mine; }
std::vector<double> Ranks::joined_at_first(const std::vector<double>& mine) const { return mine; }
void Ranks::exchange(std::span<const double> to_left, std::span<const double> to_right, std::span<double> from_left,
                     std::span<double> from_right, bool around) const {
  exchange_alone(to_left, to_right, from_left, from_right, around);
}

#endif

}  // namespace slipfront
