#pragma once

#include <string>
#include <utility>
#include <vector>

/// An open file that closes itself.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_ = -1;
};

/// A file of the page, open for reading.
struct PageFile {
  Descriptor descriptor;
  long long size = 0;
};

/// The folder that is served. Only regular files in it and in its folders can be opened; no symbolic link is followed
/// in it, so that nothing outside is served.
class PageFolder {
 public:
  /// \throws FileError if the folder cannot be opened.
  explicit PageFolder(const std::string& path);

  /// The file has no descriptor if there is no such regular file, or if it cannot be opened.
  PageFile open(const std::vector<std::string>& names) const;

 private:
  Descriptor folder_;
};
