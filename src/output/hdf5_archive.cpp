#include "output/hdf5_archive.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/errors.h"

namespace sluice {
namespace {

/// An HDF5 identifier that closes itself.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() { release(); }
  hid_t id() const { return id_; }
  bool valid() const { return id_ >= 0; }
  herr_t release() {
    const hid_t id = std::exchange(id_, -1);
    return id >= 0 ? close_(id) : 0;
  }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// HDF5 prints its error stack by default; our messages say what went wrong.
class QuietErrors {
 public:
  QuietErrors() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

hid_t memory_type(Scalar scalar) {
  switch (scalar) {
    case Scalar::f32:
      return H5T_NATIVE_FLOAT;
    case Scalar::f64:
      return H5T_NATIVE_DOUBLE;
    case Scalar::i32:
      return H5T_NATIVE_INT32;
    case Scalar::i64:
      return H5T_NATIVE_INT64;
    case Scalar::u8:
      return H5T_NATIVE_UINT8;
    case Scalar::u32:
      return H5T_NATIVE_UINT32;
    case Scalar::u64:
      return H5T_NATIVE_UINT64;
  }
  return -1;
}

constexpr std::array<Scalar, 7> scalars = {Scalar::f32, Scalar::f64, Scalar::i32, Scalar::i64,
                                           Scalar::u8,  Scalar::u32, Scalar::u64};

std::uint64_t mix(std::uint64_t h, std::uint64_t word) {
  // multiply and fold, constants of MurmurHash3's finaliser (Appleby, public domain)
  h = (h ^ word) * 0xff51afd7ed558ccdULL;
  h ^= h >> 33;
  return h * 0xc4ceb9fe1a85ec53ULL;
}

std::uint64_t hash_of(std::string_view name, Scalar scalar, std::size_t columns, std::size_t rows,
                      const void* data) {
  std::uint64_t h = 0x9e3779b97f4a7c15ULL;
  for (const char c : name) h = mix(h, static_cast<unsigned char>(c));
  h = mix(h, static_cast<std::uint64_t>(scalar));
  h = mix(h, columns);
  h = mix(h, rows);
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t left = rows * columns * size_of(scalar); left > 0;) {
    const std::size_t n = std::min<std::size_t>(left, 8);
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, n);
    h = mix(h, word);
    bytes += n;
    left -= n;
  }
  return h;
}

struct Shape {
  Scalar scalar = Scalar::u8;
  std::size_t rows = 0, columns = 0;
};

/// nullopt if the dataset is not one that an archive writes.
std::optional<Shape> shape_of(const Handle& dataset) {
  const Handle space(H5Dget_space(dataset.id()), &H5Sclose);
  const Handle type(H5Dget_type(dataset.id()), &H5Tclose);
  std::array<hsize_t, 2> size{};
  if (!space.valid() || !type.valid() || H5Sget_simple_extent_ndims(space.id()) != 2 ||
      H5Sget_simple_extent_dims(space.id(), size.data(), nullptr) != 2)
    return std::nullopt;
  for (const Scalar scalar : scalars)
    if (H5Tequal(type.id(), memory_type(scalar)) > 0) return Shape{scalar, size[0], size[1]};
  return std::nullopt;
}

bool read_all(const Handle& dataset, const Shape& shape, void* to) {
  return shape.rows == 0 ||
         H5Dread(dataset.id(), memory_type(shape.scalar), H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0;
}

/// One visit of content_hash.
struct HashVisit {
  std::uint64_t sum = 0;
  std::string problem;
};

herr_t hash_object(hid_t root, const char* name, const H5O_info_t* info, void* visit) {
  auto& v = *static_cast<HashVisit*>(visit);
  if (info->type != H5O_TYPE_DATASET) return 0;
  const Handle dataset(H5Dopen2(root, name, H5P_DEFAULT), &H5Dclose);
  const auto shape = dataset.valid() ? shape_of(dataset) : std::nullopt;
  if (!shape) {
    v.problem = fmt::format("'{}' is damaged", name);
    return 1;
  }
  std::vector<std::uint8_t> bytes(shape->rows * shape->columns * size_of(shape->scalar));
  if (!read_all(dataset, *shape, bytes.data())) {
    v.problem = fmt::format("'{}' cannot be read", name);
    return 1;
  }
  v.sum += hash_of(name, shape->scalar, shape->columns, shape->rows, bytes.data());
  return 0;
}

}  // namespace

struct Hdf5Archive::Implementation {
  std::filesystem::path path;
  ArchiveUse use = ArchiveUse::load;
  Handle file;
  std::vector<std::string> section;  ///< where we are
  std::uint64_t written_hash = 0;

  [[noreturn]] void fail(const std::string& what) const {
    throw EnvironmentError(fmt::format("{}: {}", path.string(), what));
  }
  [[noreturn]] void fail_to_write(int reason) const {
    fail(fmt::format("cannot be written ({})", reason != 0 ? std::strerror(reason) : "HDF5 refused"));
  }
  std::string path_of(std::string_view name) const {
    std::string p;
    for (const std::string& s : section) p += s + "/";
    return p + std::string(name);
  }
  Handle open(std::string_view name) const {
    Handle dataset(H5Dopen2(file.id(), path_of(name).c_str(), H5P_DEFAULT), &H5Dclose);
    if (!dataset.valid())
      fail(fmt::format("the saved state has no '{}' (another version wrote it)", path_of(name)));
    return dataset;
  }
};

Hdf5Archive::Hdf5Archive(const std::filesystem::path& file, ArchiveUse use)
    : implementation_(std::make_unique<Implementation>()) {
  const QuietErrors quiet;
  auto& a = *implementation_;
  a.path = file;
  a.use = use;
  errno = 0;
  if (use == ArchiveUse::save) {
    a.file = Handle(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), &H5Fclose);
    if (!a.file.valid()) a.fail_to_write(errno);
  } else {
    a.file = Handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
    if (!a.file.valid()) a.fail("is damaged or not a checkpoint");
  }
}

Hdf5Archive::~Hdf5Archive() = default;

bool Hdf5Archive::loading() const {
  return implementation_->use == ArchiveUse::load;
}

void Hdf5Archive::enter(std::string_view section) {
  const QuietErrors quiet;
  auto& a = *implementation_;
  a.section.emplace_back(section);
  if (loading()) return;
  const std::string path = a.path_of("");
  if (H5Lexists(a.file.id(), path.c_str(), H5P_DEFAULT) > 0) return;
  const Handle group(H5Gcreate2(a.file.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), &H5Gclose);
  if (!group.valid()) a.fail_to_write(0);
}

void Hdf5Archive::leave() {
  implementation_->section.pop_back();
}

void Hdf5Archive::write(std::string_view name, Scalar scalar, std::size_t columns, std::size_t rows,
                        const void* data) {
  const QuietErrors quiet;
  auto& a = *implementation_;
  const std::array<hsize_t, 2> size = {rows, columns};
  const Handle space(H5Screate_simple(2, size.data(), nullptr), &H5Sclose);
  const std::string path = a.path_of(name);
  errno = 0;
  const Handle dataset(H5Dcreate2(a.file.id(), path.c_str(), memory_type(scalar), space.id(), H5P_DEFAULT,
                                  H5P_DEFAULT, H5P_DEFAULT),
                       &H5Dclose);
  if (!dataset.valid())
    a.fail(fmt::format("'{}' cannot be stored (written twice, or the disk failed)", path));
  if (rows > 0 && H5Dwrite(dataset.id(), memory_type(scalar), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    a.fail_to_write(errno);
  a.written_hash += hash_of(path, scalar, columns, rows, data);
}

std::size_t Hdf5Archive::rows(std::string_view name, Scalar scalar, std::size_t columns) {
  const QuietErrors quiet;
  const auto& a = *implementation_;
  const auto shape = shape_of(a.open(name));
  if (!shape || shape->scalar != scalar || shape->columns != columns)
    a.fail(fmt::format("'{}' has another type (another version wrote it)", a.path_of(name)));
  return shape->rows;
}

void Hdf5Archive::read(std::string_view name, void* data) {
  const QuietErrors quiet;
  const auto& a = *implementation_;
  const Handle dataset = a.open(name);
  const auto shape = shape_of(dataset);
  if (!shape || !read_all(dataset, *shape, data)) a.fail(fmt::format("'{}' cannot be read", a.path_of(name)));
}

void Hdf5Archive::set_attribute(const std::string& name, const std::string& text) {
  const QuietErrors quiet;
  const auto& a = *implementation_;
  const Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type.id(), text.size() + 1);
  const Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
  const Handle attribute(
      H5Acreate2(a.file.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
  if (!attribute.valid() || H5Awrite(attribute.id(), type.id(), text.c_str()) < 0) a.fail_to_write(errno);
}

std::optional<std::string> Hdf5Archive::attribute(const std::string& name) const {
  const QuietErrors quiet;
  const Handle attribute(H5Aopen(implementation_->file.id(), name.c_str(), H5P_DEFAULT), &H5Aclose);
  if (!attribute.valid()) return std::nullopt;
  const Handle type(H5Aget_type(attribute.id()), &H5Tclose);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) > 0) return std::nullopt;
  std::string text(H5Tget_size(type.id()), '\0');
  if (H5Aread(attribute.id(), type.id(), text.data()) < 0) return std::nullopt;
  text.resize(std::strlen(text.c_str()));
  return text;
}

std::uint64_t Hdf5Archive::content_hash() const {
  const QuietErrors quiet;
  const auto& a = *implementation_;
  if (!loading()) return a.written_hash;
  HashVisit visit;
  const herr_t result =
      H5Ovisit2(a.file.id(), H5_INDEX_NAME, H5_ITER_INC, &hash_object, &visit, H5O_INFO_BASIC);
  if (!visit.problem.empty()) a.fail(visit.problem);
  if (result < 0) a.fail("its contents cannot be listed");
  return visit.sum;
}

void Hdf5Archive::close() {
  const QuietErrors quiet;
  auto& a = *implementation_;
  errno = 0;
  if (!loading() && H5Fflush(a.file.id(), H5F_SCOPE_GLOBAL) < 0) a.fail_to_write(errno);
  if (a.file.release() < 0) a.fail_to_write(errno);
}

}  // namespace sluice
