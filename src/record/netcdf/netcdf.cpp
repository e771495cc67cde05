#include "record/netcdf/netcdf.hpp"

#include <netcdf.h>
#include <netcdf_mem.h>

#include <utility>

#include "record/netcdf/dataset_file.hpp"
#include "slipfront/error.hpp"

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

}  // namespace

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

Writer::Writer(const Writer& file, const std::string& group) : Handle(file.name_, false) {
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

int Writer::characters(const std::string& name, const std::vector<int>& dimensions) {
  return variable(name, NC_CHAR, dimensions);
}

int Writer::strings(const std::string& name, const std::vector<int>& dimensions) {
  return variable(name, NC_STRING, dimensions);
}

void Writer::attribute(int variable, const std::string& name, std::string_view text) {
  if (text.size() <= longest_text) {
    require(nc_put_att_text(id_, variable, name.c_str(), text.size(), text.data()), "attribute " + name);
    return;
  }
  const std::string whole(text);  // HDF5 stores a string of variable length elsewhere in the file
  const char* pointer = whole.c_str();
  require(nc_put_att_string(id_, variable, name.c_str(), 1, &pointer), "attribute " + name);
}

void Writer::attribute(int variable, const std::string& name, int value) {
  require(nc_put_att_int(id_, variable, name.c_str(), NC_INT, 1, &value), "attribute " + name);
}

void Writer::attribute(int variable, const std::string& name, std::int64_t value) {
  const long long whole = value;
  require(nc_put_att_longlong(id_, variable, name.c_str(), NC_INT64, 1, &whole), "attribute " + name);
}

void Writer::attribute(int variable, const std::string& name, double value) {
  require(nc_put_att_double(id_, variable, name.c_str(), NC_DOUBLE, 1, &value), "attribute " + name);
}

void Writer::fill_value(int variable, double value) {
  require(nc_put_att_double(id_, variable, "_FillValue", NC_DOUBLE, 1, &value), "attribute _FillValue");
}

void Writer::end_definitions() { require(nc_enddef(id_), "cannot be created"); }

void Writer::write(int variable, std::span<const double> values) {
  if (values.empty()) return;
  const std::size_t start[] = {0}, size[] = {values.size()};
  require(nc_put_vara_double(id_, variable, start, size, values.data()), "data");
}

void Writer::write(int variable, std::string_view values) {
  if (values.empty()) return;
  const std::size_t start[] = {0}, size[] = {values.size()};
  require(nc_put_vara_uchar(id_, variable, start, size, reinterpret_cast<const unsigned char*>(values.data())), "data");
}

void Writer::write_row(int variable, std::size_t row, std::span<const double> values) {
  int rank = 0;
  require(nc_inq_varndims(id_, variable, &rank), "data");
  std::vector<int> dimensions(static_cast<std::size_t>(rank));
  require(nc_inq_vardimid(id_, variable, dimensions.data()), "data");
  std::vector<std::size_t> start(dimensions.size(), 0), size(dimensions.size(), 1);
  start[0] = row;
  for (std::size_t i = 1; i < dimensions.size(); ++i) require(nc_inq_dimlen(id_, dimensions[i], &size[i]), "data");
  require(nc_put_vara_double(id_, variable, start.data(), size.data(), values.data()), "data");
}

void Writer::write_all(int variable, const std::vector<double>& values) {
  require(nc_put_var_double(id_, variable, values.data()), "data");
}

void Writer::write_all(int variable, const std::vector<std::int64_t>& values) {
  static_assert(sizeof(long long) == sizeof(std::int64_t));
  require(nc_put_var(id_, variable, values.data()), "data");
}

void Writer::write_all(int variable, const std::vector<std::int8_t>& values) {
  require(nc_put_var_schar(id_, variable, values.data()), "data");
}

void Writer::write_all(int variable, std::string_view characters) {
  require(nc_put_var_text(id_, variable, characters.data()), "data");
}

void Writer::write_all(int variable, const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  pointers.reserve(texts.size());
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  require(nc_put_var_string(id_, variable, pointers.data()), "data");
}

Image Writer::finish() {
  NC_memio memory{};
  const int status = nc_close_memio(std::exchange(id_, -1), &memory);
  Image image{decltype(Image::memory)(memory.memory), memory.size};
  require(status, "cannot be created");
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

void Reader::read_everything() const {
  int variables = 0, globals = 0;
  require(nc_inq(id_, nullptr, &variables, &globals, nullptr), "cannot be read");
  for (int id = NC_GLOBAL; id < variables; ++id) {
    int attributes = globals;
    if (id != NC_GLOBAL) require(nc_inq_varnatts(id_, id, &attributes), "cannot be read");
    char name[NC_MAX_NAME + 1];
    for (int i = 0; i < attributes; ++i) {
      nc_type type = NC_NAT;
      std::size_t size = 0, width = 0;
      require(nc_inq_attname(id_, id, i, name), "attribute");
      require(nc_inq_att(id_, id, name, &type, &size), name);
      if (nc_inq_type(id_, type, nullptr, &width) != NC_NOERR) continue;
      if (type == NC_STRING || type > NC_MAX_ATOMIC_TYPE || (width > 0 && size > most_bytes_ / width)) continue;
      std::vector<char> values(size * width);
      if (!values.empty()) require(nc_get_att(id_, id, name, values.data()), name);
    }
    if (id == NC_GLOBAL) continue;
    require(nc_inq_varname(id_, id, name), "variable");
    const std::optional<Variable> variable = find(name);
    if (!variable || variable->kind == Variable::Kind::other) continue;
    reals(*variable);
  }
}

void Reader::read_row(const Variable& variable, std::size_t row, std::span<double> values) const {
  std::vector<std::size_t> start(variable.shape.size(), 0), size = variable.shape;
  start[0] = row;
  size[0] = 1;
  require(nc_get_vara_double(id_, variable.id, start.data(), size.data(), values.data()), variable.name);
}

}  // namespace slipfront::record::netcdf
