#pragma once
/// \file
/// NetCDF files as images in memory. The library never gets the path that the user gave. It would interpret "http://",
/// "#mode=" and blanks in it, hide the reason when a disk is full, and hold locks that exclude readers.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace slipfront::record::netcdf {

/// Longest text of an attribute, in bytes. HDF5 allows 64 KiB, which includes its own bookkeeping.
inline constexpr std::size_t longest_text = 60000;

/// The lock of the NetCDF and HDF5 libraries, which are not made for threads. All code that calls them holds it.
std::unique_lock<std::recursive_mutex> lock_netcdf();

/// The version of the NetCDF library, such as "4.9.0".
std::string library_version();

/// An open file. It holds the lock of the C library, which is not thread-safe.
class Handle {
 public:
  explicit Handle(std::string name, bool is_owner = true);
  ~Handle();
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

 protected:
  /// \throws FileError with the name, `doing` and the library's reason unless `status` is 0.
  void require(int status, std::string_view doing) const;

  std::string name_;  ///< for messages only
  int id_ = -1;       ///< -1: not open
  bool is_owner_;     ///< closes the file; false for a group

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

/// The bytes of a finished file.
struct Image {
  struct Free {
    void operator()(void* image) const { std::free(image); }
  };
  std::unique_ptr<void, Free> memory;
  std::size_t size = 0;
  std::string_view bytes() const { return {static_cast<const char*>(memory.get()), size}; }
};

/// Values or an attribute that a file must have, and a checksum of their bytes.
struct Piece {
  std::string group, variable;           ///< no variable: an attribute of the group
  std::string attribute;                 ///< empty: values of the variable
  std::vector<std::size_t> start, size;  ///< ranges of the values
  std::uint64_t sum = 0;
};

/// Writes a NetCDF-4 file: first dimensions, variables and attributes, then `end_definitions`, then the data. Because
/// the file is created in memory, its variables are in alphabetical order, and other programs can copy but not extend
/// it.
class Writer : Handle {
 public:
  static constexpr int global = -1;  ///< the "variable" that global attributes belong to

  /// With an `expected_size` in bytes, the image need not grow step by step.
  explicit Writer(std::string name, std::size_t expected_size = 0);
  /// A group of `file`, which must outlive it. It has its own dimensions and variables. Only `file` ends the
  /// definitions and is finished.
  Writer(const Writer& file, const std::string& group);

  /// A dimension of size 0 becomes an unlimited one without records, because NetCDF has no other kind.
  int dimension(const std::string& name, std::size_t size);
  int reals(const std::string& name, const std::vector<int>& dimensions);
  int integers(const std::string& name, const std::vector<int>& dimensions);        ///< 64 bits each
  int small_integers(const std::string& name, const std::vector<int>& dimensions);  ///< 8 bits each
  int bytes(const std::string& name, const std::vector<int>& dimensions);
  int strings(const std::string& name, const std::vector<int>& dimensions);
  /// Adds a text of any length. A text longer than `longest_text` must not contain NUL.
  void attribute(int variable, const std::string& name, std::string_view text);
  void attribute(int variable, const std::string& name, int value);
  void attribute(int variable, const std::string& name, std::int64_t value);
  void attribute(int variable, const std::string& name, double value);
  void end_definitions();

  void write(int variable, std::span<const double> values);
  void write(int variable, std::string_view values);
  /// Writes all values of a variable at one index of its first dimension.
  void write_row(int variable, std::size_t row, std::span<const double> values);

  /// Writes all values of a variable of any rank.
  void write_all(int variable, const std::vector<double>& values);
  void write_all(int variable, const std::vector<std::int64_t>& values);
  void write_all(int variable, const std::vector<std::int8_t>& values);
  void write_all(int variable, const std::vector<std::string>& texts);

  /// Closes the file, reads back all that was written, and compares the checksums. HDF5 can drop data silently when
  /// memory runs out. \throws std::bad_alloc if anything is missing.
  Image finish();

 private:
  int variable(const std::string& name, int type, const std::vector<int>& dimensions);
  void put_attribute(int variable, const std::string& name, int type, std::size_t count, std::string_view bytes);
  void put(int variable, int type, std::vector<std::size_t> start, std::vector<std::size_t> size, const void* values);
  void note(int variable, const std::string& attribute, std::vector<std::size_t> start, std::vector<std::size_t> size,
            std::uint64_t sum);
  std::vector<std::size_t> shape(int variable) const;

  std::vector<Piece> own_pieces_;
  std::vector<Piece>* pieces_ = &own_pieces_;  ///< those of the file, for a group
};

/// The name, type and shape of a variable in a file.
struct Variable {
  enum class Kind { real, byte, number, other };  ///< double, unsigned byte, any other number, anything else
  std::string name;
  int id;
  Kind kind;
  std::vector<std::size_t> shape;
};

/// Reads any file that netCDF-C supports, with any content. It checks the size of data before it allocates memory.
class Reader : Handle {
 public:
  /// `image` must outlive the reader. Data larger than `most_bytes` are not read.
  Reader(std::string name, std::string_view image, std::size_t most_bytes);

  std::optional<Variable> find(const std::string& name) const;
  std::optional<std::string> text(const std::string& global_attribute) const;
  std::optional<double> number(const std::string& global_attribute) const;
  std::optional<double> number(const Variable& variable, const std::string& attribute) const;

  /// All values of a numeric variable, as doubles. \throws FileError if it is not numeric, too large, or out of range.
  std::vector<double> reals(const Variable& variable) const;
  /// All values of a variable of bytes. \throws FileError if it is not of bytes, or too large.
  std::string bytes(const Variable& variable) const;
  /// Makes the checks of `reals` without reading the values. \throws FileError.
  void require_reals(const Variable& variable) const;
  /// The checksum of what the file has in place of `piece`. \throws FileError if it has nothing there.
  std::uint64_t sum_of(const Piece& piece) const;
  /// Reads all values at one index of the first dimension. Call require_reals first; values.size() must be their
  /// number.
  void read_row(const Variable& variable, std::size_t row, std::span<double> values) const;

 private:
  std::optional<double> number(int variable, const std::string& attribute) const;
  std::size_t count(const Variable& variable, std::size_t width) const;
  std::size_t most_bytes_;
};

}  // namespace slipfront::record::netcdf

namespace slipfront::record {

/// A text that is valid as an attribute in every language: `text` with '?' for each byte that is NUL or not UTF-8, cut
/// between characters to at most `most` bytes.
std::string clean_text(std::string_view text, std::size_t most);

using AttributeValue = std::variant<std::string, std::int64_t, double, int>;
using Attributes = std::vector<std::pair<std::string, AttributeValue>>;

struct DatasetVariable {
  /// Bytes that mean nothing to other programs.
  struct Opaque {
    std::string bytes;
    std::size_t size() const { return bytes.size(); }
    bool empty() const { return bytes.empty(); }
  };

  std::string name;
  std::vector<std::string> dimensions;
  /// As many as the dimensions hold, the last dimension fastest. A function returns them when they are written.
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::int8_t>, std::vector<std::string>,
               Opaque, std::function<std::vector<double>()>>
      values;
  Attributes attributes = {};  ///< _FillValue is that of a variable of doubles
};

/// The content of a file or of a group in it.
struct Dataset {
  std::vector<std::pair<std::string, std::size_t>> dimensions = {};
  std::vector<DatasetVariable> variables = {};
  Attributes attributes = {};
  std::string name = {};             ///< empty unless it is a group
  std::vector<Dataset> groups = {};  ///< they have none of their own

  /// Adds a variable of opaque bytes, with its dimension.
  void add_opaque(const std::string& variable, const std::string& long_name, std::string bytes,
                  Attributes further = {});
};

/// Writes `path` with a seal (seal.hpp), completely or not at all; an old file is unchanged if this fails. Equal
/// arguments give files that are equal byte by byte. \throws FileError (one line: path and reason), std::bad_alloc,
/// std::invalid_argument where a variable has not as many values as its dimensions say, or a dimension that is none of
/// `dataset`.
void write_dataset(const std::string& path, const Dataset& dataset);

}  // namespace slipfront::record
