#pragma once
/// \file
/// The processes ("ranks") among which a chain is shared, on one machine or many. Under mpirun they are MPI's; else
/// there is one, and MPI is not touched.

#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace slipfront {

/// One process by itself, or all that mpirun started. Calls marked (all) have to be made by all ranks in the same
/// order. None is for several threads at a time.
class Ranks {
 public:
  /// One process by itself.
  Ranks() = default;
  /// Starts MPI if mpirun (or srun) started this process, and ends it when destroyed: one object a program, which
  /// catches errors while it lives (failed). \throws InputError if there are several processes and the library was
  /// built without MPI.
  static Ranks of_mpirun();
  /// Ends MPI; the other ranks too, by force, if an exception that they do not know of is on its way.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }  ///< 0 ... size() - 1; rank 0 prints and writes
  int size() const { return size_; }
  /// The part of the ranks that runs on this machine, 0 to 1.
  double share_of_machine() const { return share_of_machine_; }
  /// Whether the library was built with MPI.
  static bool available();

  /// (all) Does `task`, which makes no call marked (all) itself. If it throws on any rank, all ranks throw the error of
  /// the lowest of them: InputError, FileError or NumericsError as it was, any other as NumericsError.
  void together(const std::function<void()>& task) const;
  /// (all) \throws InputError on all ranks unless all give the same text, which `what` names.
  void require_same(const char* what, std::string_view text) const;
  /// (all) Whether `mine` is true on any rank.
  bool any(bool mine) const;
  /// (all) What the ranks have, one after the other, on every rank. At most 2^31 - 1 numbers.
  std::vector<double> joined(const std::vector<double>& mine) const;
  /// (all) The same on rank 0; empty on others.
  std::vector<double> joined_at_first(const std::vector<double>& mine) const;
  /// (all) Each rank gives as many numbers to the rank before and to the one behind, and gets theirs. Where there is
  /// none (at the ends, unless `around`) what is received stays as it is.
  void exchange(std::span<const double> to_left, std::span<const double> to_right, std::span<double> from_left,
                std::span<double> from_right, bool around) const;

  /// For the last catch of a program. An error that all ranks threw together: rank 0 calls `say`; all return `code`.
  /// One of this rank alone: calls `say`, then ends all ranks with `code` and does not return.
  int failed(int code, const std::function<void()>& say) const;

 private:
  Ranks(int rank, int size, double share_of_machine, bool ends_mpi)
      : rank_(rank), size_(size), share_of_machine_(share_of_machine), ends_mpi_(ends_mpi) {}

  int rank_ = 0, size_ = 1;
  double share_of_machine_ = 1;
  bool ends_mpi_ = false;
  mutable bool agreed_ = false;  ///< the last error was thrown by all ranks
};

}  // namespace slipfront
