#pragma once
/// \file
/// NetCDF files as images in memory. The library never sees the user's path: it would read "http://", "#mode=" and
/// blanks in it as more than a name, hide the reason when a disk is full, and hold locks that keep readers out.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slipfront::record::netcdf {

/// Longest text that an attribute may hold. HDF5 takes 64 KiB with its own bookkeeping.
inline constexpr std::size_t longest_text = 60000;

/// An open file. The C library is not thread-safe: whoever has a file open holds its lock.
class Handle {
 public:
  explicit Handle(std::string name);
  ~Handle();
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

 protected:
  /// \throws FileError with the name, `doing` and the library's reason unless `status` is 0.
  void require(int status, std::string_view doing) const;

  std::string name_;  ///< for messages only
  int id_ = -1;       ///< -1: not open

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

/// A finished file.
struct Image {
  struct Free {
    void operator()(void* image) const { std::free(image); }
  };
  std::unique_ptr<void, Free> memory;
  std::size_t size = 0;
  std::string_view bytes() const { return {static_cast<const char*>(memory.get()), size}; }
};

/// Makes a NetCDF-4 file: dimensions, variables and attributes first, then `end_definitions`, then the data. Made in
/// memory, the file lists its variables by the alphabet, and other programs can copy but not extend it.
class Writer : Handle {
 public:
  static constexpr int global = -1;  ///< the "variable" that global attributes belong to

  /// `expected_size` in bytes spares growing the image step by step.
  explicit Writer(std::string name, std::size_t expected_size = 0);

  /// A dimension of size 0 comes out as an unlimited one without records: NetCDF has no other.
  int dimension(const std::string& name, std::size_t size);
  int reals(const std::string& name, const std::vector<int>& dimensions);
  int integers(const std::string& name, const std::vector<int>& dimensions);        ///< of 64 bits
  int small_integers(const std::string& name, const std::vector<int>& dimensions);  ///< of 8 bits
  int bytes(const std::string& name, const std::vector<int>& dimensions);
  int characters(const std::string& name, const std::vector<int>& dimensions);
  int strings(const std::string& name, const std::vector<int>& dimensions);
  /// A text of any length; one that is longer than `longest_text` must be without NUL.
  void attribute(int variable, const std::string& name, std::string_view text);
  void attribute(int variable, const std::string& name, int value);
  void attribute(int variable, const std::string& name, std::int64_t value);
  void attribute(int variable, const std::string& name, double value);
  void fill_value(int variable, double value);
  void end_definitions();

  void write(int variable, std::span<const double> values);
  void write(int variable, std::string_view values);
  void write_row(int variable, std::size_t row, std::span<const double> values);

  /// Of any rank, all of it.
  void write_all(int variable, const std::vector<double>& values);
  void write_all(int variable, const std::vector<std::int64_t>& values);
  void write_all(int variable, const std::vector<std::int8_t>& values);
  void write_all(int variable, std::string_view characters);
  void write_all(int variable, const std::vector<std::string>& texts);

  Image finish();

 private:
  int variable(const std::string& name, int type, const std::vector<int>& dimensions);
};

/// What a file says of one of its variables.
struct Variable {
  enum class Kind { real, byte, number, other };  ///< double, unsigned byte, any other number, anything else
  std::string name;
  int id;
  Kind kind;
  std::vector<std::size_t> shape;
};

/// Reads any file that netCDF-C knows, of any content. Data are allocated only after their size has been checked.
class Reader : Handle {
 public:
  /// `image` must outlive the reader. Nothing bigger than `most_bytes` is read.
  Reader(std::string name, std::string_view image, std::size_t most_bytes);

  std::optional<Variable> find(const std::string& name) const;
  std::optional<std::string> text(const std::string& global_attribute) const;
  std::optional<double> number(const std::string& global_attribute) const;
  std::optional<double> number(const Variable& variable, const std::string& attribute) const;

  /// All of a variable of numbers, as doubles. \throws FileError if it is none, too big, or out of range.
  std::vector<double> reals(const Variable& variable) const;
  /// All of a variable of bytes. \throws FileError likewise.
  std::string bytes(const Variable& variable) const;
  /// What `reals` checks. \throws FileError.
  void require_reals(const Variable& variable) const;
  /// Reads all variables and attributes and forgets them. \throws FileError where one cannot be read.
  void read_everything() const;
  /// After require_reals; values.size() must be the length of a row.
  void read_row(const Variable& variable, std::size_t row, std::span<double> values) const;

 private:
  std::optional<double> number(int variable, const std::string& attribute) const;
  std::size_t count(const Variable& variable, std::size_t width) const;
  std::size_t most_bytes_;
};

}  // namespace slipfront::record::netcdf
