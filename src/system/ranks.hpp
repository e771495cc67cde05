#pragma once
/// \file
/// The processes ("ranks") that share a chain, on one machine or many. Under mpirun they are the ranks of MPI. Without
/// mpirun there is one rank, and MPI is not used.

#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace slipfront {

/// A single process, or all processes that mpirun started. All ranks must make the calls marked (all), in the same
/// order. No member may be called from several threads at a time.
class Ranks {
 public:
  /// A single process.
  Ranks() = default;
  /// The only process, which outlives those that refer to it.
  static const Ranks& single();
  /// Starts MPI if mpirun (or srun) started this process. The destructor ends MPI, so a program must create only one
  /// such object and catch its errors (see `failed`) before the object is destroyed. \throws InputError if there are
  /// several processes and the library was built without MPI.
  static Ranks of_mpirun();
  /// Ends MPI. If an exception is in flight that the other ranks do not know of, it also aborts the other ranks.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }  ///< 0 ... size() - 1; rank 0 prints and writes
  int size() const { return size_; }
  /// The fraction of the ranks that run on this machine, 0 to 1.
  double share_of_machine() const { return share_of_machine_; }
  /// Whether the library was built with MPI.
  static bool available();

  /// (all) Runs `task`, which must not make calls marked (all). If it throws on any rank, all ranks throw the error of
  /// the lowest rank that failed. InputError, FileError and NumericsError keep their type; other errors become
  /// NumericsError.
  void together(const std::function<void()>& task) const;
  /// (all) \throws InputError on all ranks unless all give the same text. `what` names the text in the message.
  void require_same(const char* what, std::string_view text) const;
  /// (all) Whether `mine` is true on any rank.
  bool any(bool mine) const;
  /// (all) The largest of the numbers of all ranks, none of which may be NaN.
  double largest(double mine) const;
  /// (all) Joins the numbers of all ranks in the order of the ranks. Every rank gets them; at most 2^31 - 1 numbers.
  std::vector<double> joined(const std::vector<double>& mine) const;
  /// (all) Like `joined`, into an array of the right size.
  void join(std::span<const double> mine, std::span<double> all) const;
  /// (all) Like `joined`, but only rank 0 gets the numbers. The result is empty on the others.
  std::vector<double> joined_at_first(const std::vector<double>& mine) const;
  /// (all) Gives all ranks the numbers of rank 0.
  void from_first(std::span<double> numbers) const;
  enum class Neighbour { previous, next };
  /// Sends numbers to a neighbour, which must receive equally many. At an end, where there is none, it does nothing.
  void send(Neighbour to, std::span<const double> numbers) const;
  /// Waits for the numbers that a neighbour sends. At an end it leaves them unchanged.
  void receive(Neighbour from, std::span<double> numbers) const;
  /// (all) Exchanges equally many numbers with the previous and with the next rank. A rank without such a neighbour (at
  /// an end, unless `around`) leaves the numbers to receive unchanged.
  void exchange(std::span<const double> to_left, std::span<const double> to_right, std::span<double> from_left,
                std::span<double> from_right, bool around) const;

  /// The code with which this rank ends a program that all ranks end with `code`: mpirun returns that of rank 0. The
  /// others end with 0, because mpirun kills all ranks, and so rank 0, when one of them ends with another code.
  int code_of(int code) const { return rank_ == 0 ? code : 0; }
  /// For the last catch block of a program. If all ranks threw the error together, rank 0 calls `say` and all return
  /// `code_of(code)`. If only this rank threw it, the function calls `say`, ends all ranks with `code` and does not
  /// return.
  int failed(int code, const std::function<void()>& say) const;

 private:
  Ranks(int rank, int size, double share_of_machine, bool ends_mpi)
      : rank_(rank), size_(size), share_of_machine_(share_of_machine), ends_mpi_(ends_mpi) {}

  int rank_ = 0, size_ = 1;
  double share_of_machine_ = 1;
  bool ends_mpi_ = false;
  mutable bool agreed_ = false;  ///< all ranks threw the last error
};

}  // namespace slipfront
