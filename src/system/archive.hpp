#pragma once
/// \file
/// Saves and restores the state of a run. A class names its members once, for both directions:
///     void archive(Archive& a) { a(time, steps, values); }

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "slipfront/error.hpp"
#include "system/ranks.hpp"

namespace slipfront {

/// Whether a struct has nothing but doubles, so that its bytes are its members: it can be initialised by as many of
/// them as it has room for.
template <class T>
inline constexpr bool is_doubles = []<std::size_t... i>(std::index_sequence<i...>) {
  return requires { T{(static_cast<void>(i), double{})...}; };
}
(std::make_index_sequence<sizeof(T) / sizeof(double)>{});

/// Writes members to bytes, or reads them from bytes: numbers in a row, little endian as every machine that this runs
/// on. Vectors and texts follow their sizes.
class Archive {
 public:
  /// Writes to `bytes`. Replaces its contents, but uses its memory again.
  static Archive to(std::string& bytes) {
    bytes.clear();
    return Archive(&bytes, {});
  }
  /// Reads. \throws InputError, like all calls that read, if the bytes are not those of such a state.
  static Archive from(std::string_view bytes) { return Archive(nullptr, bytes); }

  bool reads() const { return to_ == nullptr; }

  /// Visits numbers, texts, vectors, optional values, structs of doubles, and classes with `archive`.
  template <class... T>
  void operator()(T&... members) {
    (visit(members), ...);
  }
  /// Vectors whose present sizes are known before they are read.
  template <class... T>
  void fixed(std::vector<T>&... members) {
    const auto one = [this](auto& values) {
      const std::size_t size = values.size();
      visit(values);
      require(values.size() == size);
    };
    (one(members), ...);
  }
  /// Members of each element, which `members` visits.
  template <class T, class Members>
  void each(std::vector<T>& values, const Members& members) {
    std::uint64_t size = values.size();
    visit(size);
    if (!reads()) {
      for (T& value : values) members(value);
      return;
    }
    values.clear();  // one by one: a size that is wrong ends with the bytes, not with the memory
    for (; size > 0; --size) members(values.emplace_back());
  }
  /// Members of a value that may be absent.
  template <class T, class Members>
  void maybe(std::optional<T>& value, const Members& members) {
    bool exists = value.has_value();
    visit(exists);
    if (reads() && exists) value.emplace();
    if (reads() && !exists) value.reset();
    if (exists) members(*value);
  }
  /// Numbers of `count` items, such as sites, of which this rank has those from `first` on and all ranks together have
  /// `all`. The first rank writes them all, and each rank reads its own.
  void parts(std::vector<double>& own, const Ranks& ranks, std::size_t first, std::size_t count, std::size_t all) {
    if (!reads()) {
      if (ranks.size() == 1) return visit(own);
      std::vector<double> joined = ranks.joined_at_first(own);
      return visit(joined);
    }
    const std::size_t columns = own.size() / count;
    require(get<std::uint64_t>() == columns * all && columns * all <= from_.size() / sizeof(double));
    const std::string_view rest = from_.substr(columns * all * sizeof(double));
    from_.remove_prefix(columns * first * sizeof(double));
    take(own.data(), own.size() * sizeof(double));
    from_ = rest;
  }
  /// Something that must be equal if the state is to be restored.
  template <class T>
  void same(T value) {
    const T now = value;
    visit(value);
    require(value == now);
  }

  /// \throws InputError if an archive that reads has read something that is not `valid`.
  void require(bool valid) const {
    if (reads() && !valid)
      throw InputError({.key = "resume",
                        .problem = "the saved state is of another version or scenario",
                        .allowed = "a file of this version and scenario, written by the same subcommand"});
  }
  /// Whether all bytes have been read.
  bool at_end() const { return from_.empty(); }

 private:
  /// Increase this number if a state that an earlier version wrote cannot be restored.
  static constexpr std::uint64_t format = 0x736c697000000b;  // "slip", version 11

  Archive(std::string* to, std::string_view from) : to_(to), from_(from) { same(format); }

  template <class T>
  static constexpr bool has_archive = requires(T& value, Archive& a) {
    value.archive(a);
  };
  /// Whether the bytes of a value are its members.
  template <class T>
  static constexpr bool is_plain = std::is_arithmetic_v<T> ||
                                   (std::is_aggregate_v<T> && std::is_trivially_copyable_v<T> && !has_archive<T> &&
                                    is_doubles<T>);

  template <class T>
  void visit(T& value) {
    static_assert(has_archive<T> || is_plain<T>);
    if constexpr (has_archive<T>)
      value.archive(*this);
    else
      raw(&value, sizeof value);
  }
  void visit(bool& value) {
    char as_byte = value ? 1 : 0;
    visit(as_byte);
    value = as_byte != 0;
  }
  void visit(std::string& text) { plain(text); }
  template <class T>
  void visit(std::vector<T>& values) {
    if constexpr (is_plain<T>)
      plain(values);
    else
      each(values, [this](T& value) { visit(value); });
  }
  template <class T>
  void visit(std::optional<T>& value) {
    maybe(value, [this](T& present) { visit(present); });
  }

  /// A container whose elements are next to each other.
  template <class Values>
  void plain(Values& values) {
    constexpr std::size_t each = sizeof(typename Values::value_type);
    std::uint64_t size = values.size();
    visit(size);
    if (reads()) {
      require(size <= from_.size() / each);
      values.resize(static_cast<std::size_t>(size));
    }
    raw(values.data(), values.size() * each);
  }
  template <class T>
  T get() {
    T value{};
    visit(value);
    return value;
  }
  void raw(void* values, std::size_t size) {
    if (reads())
      take(values, size);
    else
      to_->append(static_cast<const char*>(values), size);
  }
  void take(void* values, std::size_t size) {
    require(size <= from_.size());
    if (size > 0) std::memcpy(values, from_.data(), size);
    from_.remove_prefix(size);
  }

  std::string* to_;
  std::string_view from_;
};

/// The state of an object as bytes.
template <class State>
std::string saved(const State& state) {
  std::string bytes;
  Archive a = Archive::to(bytes);
  const_cast<State&>(state).archive(a);  // an archive that writes changes no member
  return bytes;
}
/// Continues from a saved state. \throws InputError if the bytes do not fit.
template <class State>
void restore(State& state, std::string_view bytes) {
  Archive a = Archive::from(bytes);
  state.archive(a);
  a.require(a.at_end());
}

}  // namespace slipfront
