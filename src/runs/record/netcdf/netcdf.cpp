#include "runs/record/netcdf/netcdf.hpp"

#include <dlfcn.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <map>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "slipfront/error.hpp"
#include "system/files/whole_file.hpp"
#include "text/characters.hpp"

namespace slipfront::record::netcdf {
namespace {

static_assert(Writer::global == NC_GLOBAL);

/// A plain name, which the library cannot interpret as a URL. No file of this name is created or read.
constexpr const char* plain_name = "slipfront-in-memory";

bool is_number(nc_type type) {
  return (type >= NC_BYTE && type <= NC_UINT64) && type != NC_CHAR;  // NC_STRING and user types come after NC_UINT64
}

Variable::Kind kind_of(nc_type type) {
  if (type == NC_DOUBLE) return Variable::Kind::real;
  if (type == NC_UBYTE) return Variable::Kind::byte;
  return is_number(type) ? Variable::Kind::number : Variable::Kind::other;
}

template <class T>
std::string_view bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

template <class Text>
std::uint64_t sum_of_texts(const std::vector<Text>& texts) {
  Fnv fnv;
  for (const char* text : texts) fnv.text(text ? text : "");
  return fnv.sum();
}

/// HDF5 prints its errors, in each thread that has not asked for silence. The NetCDF library asks in its first thread
/// only. We look the function up because we do not need HDF5 otherwise.
void silence_hdf5() {
  using SetAuto = int (*)(std::int64_t stack, void* print, void* data);
  static const auto set_auto = reinterpret_cast<SetAuto>(dlsym(RTLD_DEFAULT, "H5Eset_auto2"));
  if (set_auto) set_auto(0, nullptr, nullptr);  // 0: the stack of this thread
}

}  // namespace

std::unique_lock<std::recursive_mutex> lock_netcdf() {
  static std::recursive_mutex mutex;
  std::unique_lock lock(mutex);
  silence_hdf5();
  return lock;
}

std::string library_version() {
  const std::string text = nc_inq_libvers();
  return text.substr(0, text.find(' '));
}

Handle::Handle(std::string name, bool is_owner) : name_(std::move(name)), is_owner_(is_owner), lock_(lock_netcdf()) {}

Handle::~Handle() {
  if (is_owner_ && id_ >= 0) nc_close(id_);  // nc_abort would delete a file of that name from the disk
}

void Handle::require(int status, std::string_view doing) const {
  if (status == NC_NOERR) return;
  throw FileError(name_ + ": " + std::string(doing) + ": " + nc_strerror(status));
}

Writer::Writer(std::string name, std::size_t expected_size) : Handle(std::move(name)) {
  require(nc_create_mem(plain_name, NC_NETCDF4, expected_size, &id_), "cannot be created");
}

Writer::Writer(const Writer& file, const std::string& group) : Handle(file.name_, false), pieces_(file.pieces_) {
  require(nc_def_grp(file.id_, group.c_str(), &id_), "group " + group);
}

int Writer::dimension(const std::string& name, std::size_t size) {
  int id = -1;
  require(nc_def_dim(id_, name.c_str(), size, &id), "dimension " + name);
  return id;
}

int Writer::variable(const std::string& name, int type, const std::vector<int>& dimensions) {
  int id = -1;
  require(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &id), name);
  if (type != NC_STRING)
    require(nc_def_var_fill(id_, id, NC_NOFILL, nullptr),
            name);  // all values are written, so fill values are not needed
  return id;
}

int Writer::reals(const std::string& name, const std::vector<int>& dimensions) {
  return variable(name, NC_DOUBLE, dimensions);
}

int Writer::integers(const std::string& name, const std::vector<int>& dimensions) {
  return variable(name, NC_INT64, dimensions);
}

int Writer::small_integers(const std::string& name, const std::vector<int>& dimensions) {
  return variable(name, NC_BYTE, dimensions);
}

int Writer::bytes(const std::string& name, const std::vector<int>& dimensions) {
  return variable(name, NC_UBYTE, dimensions);
}

int Writer::strings(const std::string& name, const std::vector<int>& dimensions) {
  return variable(name, NC_STRING, dimensions);
}

void Writer::note(int variable, const std::string& attribute, std::vector<std::size_t> start,
                  std::vector<std::size_t> size, std::uint64_t sum) {
  char name[NC_MAX_NAME + 1] = "";
  if (variable != global) require(nc_inq_varname(id_, variable, name), "data");
  std::size_t length = 0;
  require(nc_inq_grpname_full(id_, &length, nullptr), "data");
  std::string group(length + 1, '\0');
  require(nc_inq_grpname_full(id_, nullptr, group.data()), "data");
  group.resize(length);
  pieces_->push_back({group, name, attribute, std::move(start), std::move(size), sum});
}

void Writer::put_attribute(int variable, const std::string& name, int type, std::size_t count, std::string_view bytes) {
  require(nc_put_att(id_, variable, name.c_str(), type, count, bytes.data()), "attribute " + name);
  note(variable, name, {}, {}, Fnv().words(bytes).sum());
}

void Writer::attribute(int variable, const std::string& name, std::string_view text) {
  if (text.size() <= longest_text) {
    put_attribute(variable, name, NC_CHAR, text.size(), text);
    return;
  }
  const std::string whole(text);  // HDF5 stores a string of variable length elsewhere in the file
  const char* pointer = whole.c_str();
  require(nc_put_att_string(id_, variable, name.c_str(), 1, &pointer), "attribute " + name);
  note(variable, name, {}, {}, sum_of_texts(std::vector{pointer}));
}

void Writer::attribute(int variable, const std::string& name, int value) {
  put_attribute(variable, name, NC_INT, 1, bytes_of(value));
}

void Writer::attribute(int variable, const std::string& name, std::int64_t value) {
  put_attribute(variable, name, NC_INT64, 1, bytes_of(value));
}

void Writer::attribute(int variable, const std::string& name, double value) {
  put_attribute(variable, name, NC_DOUBLE, 1, bytes_of(value));
}

void Writer::end_definitions() { require(nc_enddef(id_), "cannot be created"); }

std::vector<std::size_t> Writer::shape(int variable) const {
  int rank = 0;
  require(nc_inq_varndims(id_, variable, &rank), "data");
  std::vector<int> dimensions(static_cast<std::size_t>(rank));
  require(nc_inq_vardimid(id_, variable, dimensions.data()), "data");
  std::vector<std::size_t> sizes(dimensions.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) require(nc_inq_dimlen(id_, dimensions[i], &sizes[i]), "data");
  return sizes;
}

void Writer::put(int variable, int type, std::vector<std::size_t> start, std::vector<std::size_t> size,
                 const void* values) {
  nc_type own_type = NC_NAT;
  std::size_t bytes = 0;
  require(nc_inq_vartype(id_, variable, &own_type), "data");
  if (own_type != type) throw std::invalid_argument("netcdf::Writer: values of another type than the variable");
  require(nc_inq_type(id_, type, nullptr, &bytes), "data");
  for (const std::size_t n : size) bytes *= n;
  require(nc_put_vara(id_, variable, start.data(), size.data(), values), "data");
  note(variable, "", std::move(start), std::move(size), Fnv().words({static_cast<const char*>(values), bytes}).sum());
}

void Writer::write(int variable, std::span<const double> values) {
  if (!values.empty()) put(variable, NC_DOUBLE, {0}, {values.size()}, values.data());
}

void Writer::write(int variable, std::string_view values) {
  if (!values.empty()) put(variable, NC_UBYTE, {0}, {values.size()}, values.data());
}

void Writer::write_row(int variable, std::size_t row, std::span<const double> values) {
  std::vector<std::size_t> size = shape(variable), start(size.size(), 0);
  start[0] = row;
  size[0] = 1;
  put(variable, NC_DOUBLE, std::move(start), std::move(size), values.data());
}

void Writer::write_all(int variable, const std::vector<double>& values) {
  const std::vector<std::size_t> size = shape(variable);
  put(variable, NC_DOUBLE, std::vector<std::size_t>(size.size()), size, values.data());
}

void Writer::write_all(int variable, const std::vector<std::int64_t>& values) {
  const std::vector<std::size_t> size = shape(variable);
  put(variable, NC_INT64, std::vector<std::size_t>(size.size()), size, values.data());
}

void Writer::write_all(int variable, const std::vector<std::int8_t>& values) {
  const std::vector<std::size_t> size = shape(variable);
  put(variable, NC_BYTE, std::vector<std::size_t>(size.size()), size, values.data());
}

void Writer::write_all(int variable, const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  pointers.reserve(texts.size());
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  require(nc_put_var_string(id_, variable, pointers.data()), "data");
  const std::vector<std::size_t> size = shape(variable);
  note(variable, "", std::vector<std::size_t>(size.size()), size, sum_of_texts(pointers));
}

Image Writer::finish() {
  NC_memio memory{};
  const int status = nc_close_memio(std::exchange(id_, -1), &memory);
  Image image{decltype(Image::memory)(memory.memory), memory.size};
  require(status, "cannot be created");
  const Reader file(name_, image.bytes(), image.size);
  for (const Piece& piece : *pieces_)
    if (file.sum_of(piece) != piece.sum) throw std::bad_alloc();
  return image;
}

Reader::Reader(std::string name, std::string_view image, std::size_t most_bytes)
    : Handle(std::move(name)), most_bytes_(most_bytes) {
  // With NC_NOWRITE the library does not write to the image, although its signature takes a non-const pointer.
  void* memory = const_cast<char*>(image.data());
  require(nc_open_mem(plain_name, NC_NOWRITE, image.size(), memory, &id_), "cannot be read");
}

std::optional<Variable> Reader::find(const std::string& name) const {
  Variable found{name, -1, Variable::Kind::other, {}};
  if (nc_inq_varid(id_, name.c_str(), &found.id) != NC_NOERR) return {};
  nc_type type = NC_NAT;
  int rank = 0;
  require(nc_inq_vartype(id_, found.id, &type), name);
  require(nc_inq_varndims(id_, found.id, &rank), name);
  found.kind = kind_of(type);
  std::vector<int> dimensions(static_cast<std::size_t>(rank));
  require(nc_inq_vardimid(id_, found.id, dimensions.data()), name);
  for (const int dimension : dimensions) {
    std::size_t size = 0;
    require(nc_inq_dimlen(id_, dimension, &size), name);
    found.shape.push_back(size);
  }
  return found;
}

std::optional<std::string> Reader::text(const std::string& global_attribute) const {
  nc_type type = NC_NAT;
  std::size_t size = 0;
  if (nc_inq_att(id_, NC_GLOBAL, global_attribute.c_str(), &type, &size) != NC_NOERR || type != NC_CHAR) return {};
  if (size > most_bytes_) return {};
  std::string value(size, '\0');
  require(nc_get_att_text(id_, NC_GLOBAL, global_attribute.c_str(), value.data()), "attribute " + global_attribute);
  return value;
}

std::optional<double> Reader::number(int variable, const std::string& attribute) const {
  nc_type type = NC_NAT;
  std::size_t size = 0;
  if (nc_inq_att(id_, variable, attribute.c_str(), &type, &size) != NC_NOERR || !is_number(type) || size != 1)
    return {};
  double value = 0;
  require(nc_get_att_double(id_, variable, attribute.c_str(), &value), "attribute " + attribute);
  return value;
}

std::optional<double> Reader::number(const std::string& global_attribute) const {
  return number(NC_GLOBAL, global_attribute);
}

std::optional<double> Reader::number(const Variable& variable, const std::string& attribute) const {
  return number(variable.id, attribute);
}

std::size_t Reader::count(const Variable& variable, std::size_t width) const {
  std::size_t product = 1;
  for (const std::size_t size : variable.shape) {
    if (size == 0) return 0;
    if (size > most_bytes_ / width / product)
      throw FileError(name_ + ": " + variable.name + ": more data than the limit of " + std::to_string(most_bytes_) +
                      " bytes");
    product *= size;
  }
  return product;
}

void Reader::require_reals(const Variable& variable) const {
  if (variable.kind == Variable::Kind::other) throw FileError(name_ + ": " + variable.name + ": holds no numbers");
  count(variable, sizeof(double));
}

std::vector<double> Reader::reals(const Variable& variable) const {
  require_reals(variable);
  std::vector<double> values(count(variable, sizeof(double)));
  if (!values.empty()) require(nc_get_var_double(id_, variable.id, values.data()), variable.name);
  return values;
}

std::string Reader::bytes(const Variable& variable) const {
  if (variable.kind != Variable::Kind::byte) throw FileError(name_ + ": " + variable.name + ": holds no bytes");
  std::string values(count(variable, 1), '\0');
  if (!values.empty())
    require(nc_get_var_uchar(id_, variable.id, reinterpret_cast<unsigned char*>(values.data())), variable.name);
  return values;
}

std::uint64_t Reader::sum_of(const Piece& piece) const {
  const bool is_attribute = !piece.attribute.empty();
  const std::string& name = is_attribute ? piece.attribute : piece.variable;
  int group = -1, variable = NC_GLOBAL;
  require(nc_inq_grp_full_ncid(id_, piece.group.c_str(), &group), name);
  if (!piece.variable.empty()) require(nc_inq_varid(group, piece.variable.c_str(), &variable), name);
  nc_type type = NC_NAT;
  std::size_t count = 1, width = 0;
  if (is_attribute) {
    require(nc_inq_att(group, variable, name.c_str(), &type, &count), name);
  } else {
    require(nc_inq_vartype(group, variable, &type), name);
    for (const std::size_t size : piece.size) count *= size;
  }
  require(nc_inq_type(group, type, nullptr, &width), name);
  std::vector<char> bytes(count * width);
  require(is_attribute ? nc_get_att(group, variable, name.c_str(), bytes.data())
                       : nc_get_vara(group, variable, piece.start.data(), piece.size.data(), bytes.data()),
          name);
  if (type != NC_STRING) return Fnv().words({bytes.data(), bytes.size()}).sum();
  std::vector<char*> texts(count);
  std::memcpy(texts.data(), bytes.data(), bytes.size());
  const std::uint64_t sum = sum_of_texts(texts);
  nc_free_string(count, texts.data());
  return sum;
}

void Reader::read_row(const Variable& variable, std::size_t row, std::span<double> values) const {
  std::vector<std::size_t> start(variable.shape.size(), 0), size = variable.shape;
  start[0] = row;
  size[0] = 1;
  require(nc_get_vara_double(id_, variable.id, start.data(), size.data(), values.data()), variable.name);
}

}  // namespace slipfront::record::netcdf

namespace slipfront::record {

std::string clean_text(std::string_view text, std::size_t most) {
  std::string clean;
  while (!text.empty()) {
    const std::size_t length = text.front() == '\0' ? 0 : utf8_length(text);
    if (clean.size() + (length ? length : 1) > most) break;
    if (length == 0) {
      clean += '?';
      text.remove_prefix(1);
    } else {
      clean.append(text.substr(0, length));
      text.remove_prefix(length);
    }
  }
  return clean;
}

void Dataset::add_opaque(const std::string& variable, const std::string& long_name, std::string bytes,
                         Attributes further) {
  const std::string dimension = variable + "_bytes";
  dimensions.emplace_back(dimension, bytes.size());
  Attributes about = {{"long_name", long_name}, {"units", "1"}};
  about.insert(about.end(), further.begin(), further.end());
  variables.push_back({variable, {dimension}, DatasetVariable::Opaque{std::move(bytes)}, std::move(about)});
}

namespace {

using netcdf::Writer;
using Opaque = DatasetVariable::Opaque;

void add_attributes(Writer& file, int variable, const Attributes& attributes) {
  for (const auto& [name, value] : attributes)
    if (const auto* text = std::get_if<std::string>(&value))
      file.attribute(variable, name, clean_text(*text, text->size()));
    else if (const auto* whole = std::get_if<std::int64_t>(&value))
      file.attribute(variable, name, *whole);
    else if (const auto* real = std::get_if<double>(&value))
      file.attribute(variable, name, *real);
    else
      file.attribute(variable, name, std::get<int>(value));
}

/// Defines a variable and returns its id.
int defined(Writer& file, const DatasetVariable& variable, const std::vector<int>& dimensions) {
  if (std::holds_alternative<Opaque>(variable.values)) return file.bytes(variable.name, dimensions);
  if (std::holds_alternative<std::vector<std::string>>(variable.values)) return file.strings(variable.name, dimensions);
  if (std::holds_alternative<std::vector<std::int64_t>>(variable.values))
    return file.integers(variable.name, dimensions);
  if (std::holds_alternative<std::vector<std::int8_t>>(variable.values))
    return file.small_integers(variable.name, dimensions);
  return file.reals(variable.name, dimensions);
}

/// The id of each variable of a file or group, which are defined and not written.
std::vector<int> define(Writer& file, const Dataset& dataset) {
  add_attributes(file, Writer::global, dataset.attributes);
  std::map<std::string, int> dimensions;
  for (const auto& [name, size] : dataset.dimensions) dimensions[name] = file.dimension(name, size);
  std::vector<int> ids;
  for (const DatasetVariable& variable : dataset.variables) {
    std::vector<int> axes;
    for (const std::string& name : variable.dimensions) axes.push_back(dimensions.at(name));
    ids.push_back(defined(file, variable, axes));
    add_attributes(file, ids.back(), variable.attributes);
  }
  return ids;
}

/// The number of values of a variable.
std::size_t size_of(const Dataset& dataset, const DatasetVariable& variable) {
  std::size_t size = 1;
  for (const std::string& name : variable.dimensions) {
    const auto is_it = [&](const auto& dimension) { return dimension.first == name; };
    const auto found = std::find_if(dataset.dimensions.begin(), dataset.dimensions.end(), is_it);
    if (found == dataset.dimensions.end()) throw std::invalid_argument("write_dataset: " + name + " is no dimension");
    size *= found->second;
  }
  return size;
}

void write(Writer& file, const Dataset& dataset, const std::vector<int>& ids) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const DatasetVariable& variable = dataset.variables[i];
    const auto put = [&](const auto& values) {
      if (values.size() != size_of(dataset, variable))
        throw std::invalid_argument("write_dataset: " + variable.name + " has not as many values as its dimensions");
      if (values.empty()) return;  // a dimension of size 0 is an unlimited one
      if constexpr (std::is_same_v<decltype(values), const Opaque&>)
        file.write(ids[i], values.bytes);
      else
        file.write_all(ids[i], values);
    };
    const auto* const later = std::get_if<std::function<std::vector<double>()>>(&variable.values);
    later ? put((*later)())
          : std::visit(
                [&](const auto& values) {
                  if constexpr (!std::is_invocable_v<decltype(values)>) put(values);
                },
                variable.values);
  }
}

/// About the number of bytes of a file, which need not be exact.
std::size_t expected_size(const Dataset& dataset) {
  std::size_t size = 1 << 16;
  for (const DatasetVariable& variable : dataset.variables)
    size += size_of(dataset, variable) * (std::holds_alternative<Opaque>(variable.values) ? 1 : sizeof(double));
  for (const Dataset& group : dataset.groups) size += expected_size(group);
  return size;
}

}  // namespace

void write_dataset(const std::string& path, const Dataset& dataset) {
  const std::size_t size = expected_size(dataset);  // checks all dimensions
  replace_file(path, [&](const Put& put) {
    Writer file(path, size);
    const std::vector<int> ids = define(file, dataset);
    std::deque<Writer> groups;
    std::vector<std::vector<int>> ids_of_groups;
    for (const Dataset& group : dataset.groups)
      ids_of_groups.push_back(define(groups.emplace_back(file, group.name), group));
    file.end_definitions();
    write(file, dataset, ids);
    for (std::size_t i = 0; i < groups.size(); ++i) write(groups[i], dataset.groups[i], ids_of_groups[i]);
    const netcdf::Image image = file.finish();
    put(image.bytes());
    put(seal(image.bytes()));
  });
}

}  // namespace slipfront::record
