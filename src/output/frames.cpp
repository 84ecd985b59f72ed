#include "output/frames.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <charconv>

#include "base/errors.h"
#include "output/rock_mesh.h"
#include "output/run_folder.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr int surface_divisions = 3;  // 108 triangles a rock

/// Values of one field, n components each.
template <class At>
void add_field(vtkDataSetAttributes* to, const char* name, std::size_t rows, int components, const At& at) {
  vtkNew<vtkFloatArray> field;
  field->SetName(name);
  field->SetNumberOfComponents(components);
  field->SetNumberOfTuples(static_cast<vtkIdType>(rows));
  for (std::size_t i = 0; i < rows; ++i)
    for (int k = 0; k < components; ++k)
      field->SetComponent(static_cast<vtkIdType>(i), k, static_cast<float>(at(i, k)));
  to->AddArray(field);
}

template <class At>
void add_whole(vtkDataSetAttributes* to, const char* name, std::size_t rows, const At& at) {
  vtkNew<vtkLongLongArray> field;
  field->SetName(name);
  field->SetNumberOfValues(static_cast<vtkIdType>(rows));
  for (std::size_t i = 0; i < rows; ++i)
    field->SetValue(static_cast<vtkIdType>(i), static_cast<long long>(at(i)));
  to->AddArray(field);
}

/// Points with one vertex each, so that a viewer shows them without a glyph.
void set_points(vtkPolyData* data, const std::vector<Vec3>& x) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  points->SetNumberOfPoints(static_cast<vtkIdType>(x.size()));
  for (vtkIdType i = 0; i < static_cast<vtkIdType>(x.size()); ++i) {
    points->SetPoint(i, x[static_cast<std::size_t>(i)].data());
    vertices->InsertNextCell(1, &i);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);
}

void write_vtp(const fs::path& file, vtkPolyData* data) {
  const fs::path temporary = file.string() + ".tmp";
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(temporary.c_str());
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->SetEncodeAppendedData(false);
  writer->SetCompressorTypeToLZ4();
  if (writer->Write() != 1 || writer->GetErrorCode() != 0) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw EnvironmentError(fmt::format("{}: cannot be written (disk full, or no permission)", file.string()));
  }
  replace_file(temporary, file);
}

void write_rocks(const fs::path& file, const RockSnapshot& rocks) {
  vtkNew<vtkPolyData> data;
  set_points(data, rocks.x);
  const std::size_t n = rocks.count();
  vtkPointData* to = data->GetPointData();
  add_whole(to, "id", n, [&](std::size_t i) { return rocks.id[i]; });
  add_whole(to, "shape", n, [&](std::size_t i) { return rocks.shape[i]; });
  add_field(to, "size", n, 1, [&](std::size_t i, int) { return rocks.size[i]; });
  add_field(to, "mass", n, 1, [&](std::size_t i, int) { return rocks.mass[i]; });
  add_field(to, "velocity", n, 3, [&](std::size_t i, int k) { return rocks.v[i][k]; });
  add_field(to, "semi_axes", n, 3, [&](std::size_t i, int k) { return rocks.semi_axes[i][k]; });
  add_field(to, "blockiness", n, 1, [&](std::size_t i, int) { return rocks.blockiness[i]; });
  add_field(to, "wetted", n, 1, [&](std::size_t i, int) { return rocks.wetted[i]; });
  add_field(to, "quaternion", n, 4,
            [&](std::size_t i, int k) { return k == 0 ? rocks.q[i].w() : rocks.q[i].vec()[k - 1]; });
  write_vtp(file, data);
}

void write_rock_surfaces(const fs::path& file, const RockSnapshot& rocks) {
  const SurfaceMesh grid = cube_grid(surface_divisions);
  const std::size_t per_rock = grid.triangles.size();
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    const SurfaceMesh mesh = superquadric_mesh(grid, rocks.semi_axes[i], rocks.blockiness[i]);
    const vtkIdType first = points->GetNumberOfPoints();
    for (const Vec3& x : mesh.vertices) points->InsertNextPoint(Vec3(rocks.x[i] + rocks.q[i] * x).data());
    for (const auto& t : mesh.triangles) {
      const std::array<vtkIdType, 3> corner = {first + t[0], first + t[1], first + t[2]};
      triangles->InsertNextCell(3, corner.data());
    }
  }
  data->SetPoints(points);
  data->SetPolys(triangles);
  const std::size_t n = rocks.count() * per_rock;
  vtkCellData* to = data->GetCellData();
  add_whole(to, "id", n, [&](std::size_t i) { return rocks.id[i / per_rock]; });
  add_field(to, "size", n, 1, [&](std::size_t i, int) { return rocks.size[i / per_rock]; });
  add_field(to, "speed", n, 1, [&](std::size_t i, int) { return rocks.v[i / per_rock].norm(); });
  add_field(to, "wetted", n, 1, [&](std::size_t i, int) { return rocks.wetted[i / per_rock]; });
  write_vtp(file, data);
}

void write_water(const fs::path& file, const WaterPoints& water) {
  vtkNew<vtkPolyData> data;
  set_points(data, water.x);
  const std::size_t n = water.count();
  vtkPointData* to = data->GetPointData();
  add_whole(to, "id", n, [&](std::size_t i) { return water.id[i]; });
  add_field(to, "velocity", n, 3, [&](std::size_t i, int k) { return water.v[i][k]; });
  add_field(to, "mass", n, 1, [&](std::size_t i, int) { return water.mass[i]; });
  add_field(to, "fines_fraction", n, 1, [&](std::size_t i, int) {
    return water.mass[i] > 0 ? water.fines_mass[i] / water.mass[i] : 0.0;
  });
  add_field(to, "J", n, 1, [&](std::size_t i, int) { return water.J[i]; });
  add_field(to, "pressure", n, 1, [&](std::size_t i, int) { return water.pressure[i]; });
  write_vtp(file, data);
}

/// The walls that `shown` picks, where they are at `time` [s]; numbered as in the scene.
template <class Shown>
void write_wall_meshes(const fs::path& file, const std::vector<Wall>& walls, double time,
                       const Shown& shown) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIntArray> wall_index;
  vtkNew<vtkStringArray> names;
  wall_index->SetName("wall");
  names->SetName("wall_names");
  for (std::size_t w = 0; w < walls.size(); ++w) {
    names->InsertNextValue(walls[w].name);
    if (!shown(walls[w])) continue;
    const vtkIdType first = points->GetNumberOfPoints();
    const TriMesh mesh = mesh_at(walls[w], time);
    for (const Vec3& x : mesh.vertices) points->InsertNextPoint(x.data());
    for (const auto& t : mesh.triangles) {
      const std::array<vtkIdType, 3> corner = {first + t[0], first + t[1], first + t[2]};
      triangles->InsertNextCell(3, corner.data());
      wall_index->InsertNextValue(static_cast<int>(w));
    }
  }
  data->SetPoints(points);
  data->SetPolys(triangles);
  data->GetCellData()->AddArray(wall_index);
  data->GetFieldData()->AddArray(names);
  write_vtp(file, data);
}

bool moves(const Wall& wall) {
  return wall.motion.has_value();
}

/// The text between `key="` and the next quotation mark, from `from` on; `from` moves behind it.
std::optional<std::string> quoted_after(const std::string& text, const std::string& key, std::size_t& from) {
  const std::size_t at = text.find(key + "=\"", from);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t begin = at + key.size() + 2;
  const std::size_t end = text.find('"', begin);
  if (end == std::string::npos) return std::nullopt;
  from = end;
  return text.substr(begin, end - begin);
}

template <class T>
T number_in(const std::string& text) {
  T number{};
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

FrameWriter::FrameWriter(fs::path folder, RockSurface surface, std::optional<double> resume_time)
    : folder_(std::move(folder)), surface_(surface) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    throw EnvironmentError(
        fmt::format("{}: the folder cannot be made ({})", folder_.string(), error.message()));
  if (resume_time)
    read_collections(*resume_time);
  else
    clear_folder();
}

void FrameWriter::write_walls(const std::vector<Wall>& walls) {
  write_wall_meshes(folder_ / "walls.vtp", walls, 0, [](const Wall& wall) { return !moves(wall); });
}

void FrameWriter::write(const Snapshot& snapshot) {
  const auto name = [&](const char* series) { return fmt::format("{}_{:06d}.vtp", series, next_number_); };
  if (snapshot.rocks) {
    write_rocks(folder_ / name("rocks"), *snapshot.rocks);
    add("rocks", snapshot.time, name("rocks"));
    if (surface_ == RockSurface::tessellated) {
      write_rock_surfaces(folder_ / name("rocks_surface"), *snapshot.rocks);
      add("rocks_surface", snapshot.time, name("rocks_surface"));
    }
  }
  if (snapshot.water) {
    write_water(folder_ / name("water"), *snapshot.water);
    add("water", snapshot.time, name("water"));
  }
  if (snapshot.walls && std::any_of(snapshot.walls->begin(), snapshot.walls->end(), moves)) {
    write_wall_meshes(folder_ / name("moving_walls"), *snapshot.walls, snapshot.time, moves);
    add("moving_walls", snapshot.time, name("moving_walls"));
  }
  ++next_number_;
}

std::size_t FrameWriter::count() const {
  std::size_t most = 0;
  for (const auto& [series, entries] : collections_) most = std::max(most, entries.size());
  return most;
}

void FrameWriter::add(const std::string& series, double time, const std::string& file) {
  collections_[series].push_back({time, file});
  write_collection(series);
}

void FrameWriter::write_collection(const std::string& series) const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const Entry& e : collections_.at(series))
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", e.time, e.file);
  write_atomically(folder_ / (series + ".pvd"), text + "  </Collection>\n</VTKFile>\n");
}

void FrameWriter::read_collections(double resume_time) {
  const double limit = resume_time + 1e-12 * std::max(1.0, std::abs(resume_time));
  for (const char* series : {"rocks", "rocks_surface", "water", "moving_walls"}) {
    const fs::path file = folder_ / (std::string(series) + ".pvd");
    std::error_code error;
    if (!fs::exists(file, error)) continue;
    const std::string text = read_whole_file(file);
    std::vector<Entry>& kept = collections_[series];
    for (std::size_t at = 0;;) {
      const auto time = quoted_after(text, "timestep", at);
      const auto name = quoted_after(text, "file", at);
      if (!time || !name) break;
      const Entry entry{number_in<double>(*time), *name};
      if (entry.time > limit) {
        fs::remove(folder_ / entry.file, error);
        continue;
      }
      kept.push_back(entry);
      const std::size_t digits = name->rfind('_') + 1;
      next_number_ = std::max(next_number_, 1 + number_in<int>(name->substr(digits)));
    }
    write_collection(series);
  }
}

void FrameWriter::clear_folder() const {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".vtp" || extension == ".pvd") fs::remove(entry.path(), error);
    if (error)
      throw EnvironmentError(
          fmt::format("{}: an older frame cannot be removed ({})", entry.path().string(), error.message()));
  }
}

}  // namespace sluice
