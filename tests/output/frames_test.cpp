#include "output/frames.h"

#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>

#include "base/errors.h"
#include "output/run_folder.h"
#include "output/temporary_folder.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

Snapshot two_rocks_and_water(double time) {
  Snapshot s;
  s.time = time;
  RockSnapshot& r = s.rocks.emplace();
  for (int i = 0; i < 2; ++i) {
    r.id.push_back(static_cast<std::uint64_t>(7 + i));
    r.x.emplace_back(i, 2, 3);
    r.v.emplace_back(0, 0, -1 - i);
    r.q.emplace_back(Eigen::AngleAxisd(0.5 * i, Vec3::UnitX()));
    r.semi_axes.emplace_back(0.1, 0.05, 0.04);
    r.blockiness.push_back(i == 0 ? 2 : 8);
    r.size.push_back(0.1);
    r.mass.push_back(2.5);
    r.wetted.push_back(0.25);
    r.shape.push_back(i);
  }
  WaterPoints& w = s.water.emplace();
  w.id = {1, 2, 3};
  w.x = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  w.v = {Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)};
  w.mass = {1, 1, 2};
  w.fines_mass = {0, 0.5, 0.5};
  w.J = {1, 1, 0.99};
  w.pressure = {0, 10, 20};
  return s;
}

vtkSmartPointer<vtkPolyData> read_vtp(const fs::path& file) {
  vtkNew<vtkXMLPolyDataReader> reader;
  EXPECT_EQ(reader->CanReadFile(file.c_str()), 1) << file;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

TEST(Frames, AreReadBackByVtk) {
  const TemporaryFolder temporary;
  FrameWriter frames(temporary.path, RockSurface::tessellated, std::nullopt);
  frames.write(two_rocks_and_water(0.5));

  const auto rocks = read_vtp(temporary.path / "rocks_000000.vtp");
  ASSERT_EQ(rocks->GetNumberOfPoints(), 2);
  EXPECT_EQ(rocks->GetPoint(1)[0], 1.0);
  vtkPointData* fields = rocks->GetPointData();
  EXPECT_EQ(fields->GetArray("id")->GetTuple1(1), 8);
  EXPECT_EQ(fields->GetArray("velocity")->GetTuple3(1)[2], -2);
  EXPECT_EQ(fields->GetArray("blockiness")->GetTuple1(1), 8);
  EXPECT_FLOAT_EQ(static_cast<float>(fields->GetArray("semi_axes")->GetTuple3(0)[1]), 0.05F);
  EXPECT_FLOAT_EQ(static_cast<float>(fields->GetArray("quaternion")->GetTuple4(1)[0]),
                  static_cast<float>(std::cos(0.25)));
  for (const char* name : {"size", "mass", "wetted", "shape"})
    EXPECT_NE(fields->GetArray(name), nullptr) << name;

  const auto water = read_vtp(temporary.path / "water_000000.vtp");
  ASSERT_EQ(water->GetNumberOfPoints(), 3);
  EXPECT_EQ(water->GetPointData()->GetArray("fines_fraction")->GetTuple1(1), 0.5);
  EXPECT_EQ(water->GetPointData()->GetArray("pressure")->GetTuple1(2), 20);
}

TEST(Frames, ShowARocksRealShape) {
  const TemporaryFolder temporary;
  FrameWriter frames(temporary.path, RockSurface::tessellated, std::nullopt);
  const Snapshot s = two_rocks_and_water(0);
  frames.write(s);
  const auto surface = read_vtp(temporary.path / "rocks_surface_000000.vtp");
  const vtkIdType per_rock = surface->GetNumberOfPoints() / 2;
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p) {
    const std::size_t i = p < per_rock ? 0 : 1;
    const Vec3 x = s.rocks->q[i].conjugate() * (Vec3(surface->GetPoint(p)) - s.rocks->x[i]);
    const double F = superquadric_function(s.rocks->semi_axes[i], s.rocks->blockiness[i], x);
    EXPECT_NEAR(F, 1, 1e-3);  // single precision at 3 m on semi-axes of 40 mm, power 8
  }
  EXPECT_EQ(surface->GetCellData()->GetArray("id")->GetTuple1(surface->GetNumberOfCells() - 1), 8);
}

TEST(Frames, LeaveOutWhatTheSceneLacks) {
  const TemporaryFolder temporary;
  FrameWriter frames(temporary.path, RockSurface::none, std::nullopt);
  Snapshot dry = two_rocks_and_water(0);
  dry.water.reset();
  frames.write(dry);
  EXPECT_TRUE(fs::exists(temporary.path / "rocks.pvd"));
  EXPECT_FALSE(fs::exists(temporary.path / "water.pvd"));
  EXPECT_FALSE(fs::exists(temporary.path / "rocks_surface.pvd"));
}

TEST(Frames, HoldASceneWithoutASingleRock) {
  const TemporaryFolder temporary;
  FrameWriter frames(temporary.path, RockSurface::tessellated, std::nullopt);
  Snapshot empty;
  empty.rocks.emplace();
  empty.water.emplace();
  frames.write(empty);
  EXPECT_EQ(read_vtp(temporary.path / "rocks_000000.vtp")->GetNumberOfPoints(), 0);
}

TEST(Frames, AreTheSameAfterAResumeAsWithoutAStop) {
  const TemporaryFolder one, two;
  {
    FrameWriter frames(one.path, RockSurface::none, std::nullopt);
    for (int k = 0; k < 5; ++k) frames.write(two_rocks_and_water(0.1 * k));
  }
  {
    FrameWriter frames(two.path, RockSurface::none, std::nullopt);
    for (int k = 0; k < 4; ++k) frames.write(two_rocks_and_water(0.1 * k));
  }
  FrameWriter frames(two.path, RockSurface::none, 0.1 * 2);
  EXPECT_EQ(frames.count(), 3u);
  EXPECT_FALSE(fs::exists(two.path / "rocks_000003.vtp"));
  for (int k = 3; k < 5; ++k) frames.write(two_rocks_and_water(0.1 * k));
  for (const char* name : {"rocks.pvd", "water.pvd", "rocks_000003.vtp", "water_000004.vtp"})
    EXPECT_EQ(read_whole_file(one.path / name), read_whole_file(two.path / name)) << name;
}

TEST(Frames, CollectTheirTimesForParaview) {
  const TemporaryFolder temporary;
  FrameWriter frames(temporary.path, RockSurface::none, std::nullopt);
  frames.write(two_rocks_and_water(0.25));
  const std::string pvd = read_whole_file(temporary.path / "water.pvd");
  EXPECT_NE(pvd.find("<DataSet timestep=\"0.25\" part=\"0\" file=\"water_000000.vtp\"/>"), std::string::npos)
      << pvd;
}

TEST(Frames, NameTheWalls) {
  const TemporaryFolder temporary;
  FrameWriter frames(temporary.path, RockSurface::none, std::nullopt);
  std::vector<Wall> walls(2);
  walls[0].name = "back plate";
  walls[0].mesh = make_rectangle("back plate", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  walls[1].name = "ledge";
  walls[1].mesh = make_box("ledge", {Vec3(0, 0, 0), Vec3(1, 1, 1)});
  frames.write_walls(walls);
  const auto mesh = read_vtp(temporary.path / "walls.vtp");
  EXPECT_EQ(mesh->GetNumberOfCells(), 14);
  EXPECT_EQ(mesh->GetCellData()->GetArray("wall")->GetTuple1(2), 1);
  EXPECT_NE(mesh->GetFieldData()->GetAbstractArray("wall_names"), nullptr);
}

TEST(Frames, SayThatTheyCannotBeWritten) {
  const TemporaryFolder temporary;
  write_atomically(temporary.path / "file", "x");
  EXPECT_THROW(FrameWriter(temporary.path / "file" / "frames", RockSurface::none, std::nullopt),
               EnvironmentError);
}

TEST(Frames, ShowMovingWallsWhereTheyAreAndTheOthersOnce) {
  const TemporaryFolder temporary;
  std::vector<Wall> walls(2);
  walls[0].name = "floor";
  walls[0].mesh = make_box("floor", {Vec3(0, 0, 0), Vec3(1, 1, 1)});
  walls[1].name = "drum";
  walls[1].mesh = make_box("drum", {Vec3(0, 0, 0), Vec3(2, 1, 1)});
  walls[1].motion.emplace();
  walls[1].motion->kind = MotionKind::rotation;
  walls[1].motion->axis = Vec3::UnitZ();
  walls[1].motion->speed = 2;
  FrameWriter frames(temporary.path, RockSurface::none, std::nullopt);
  frames.write_walls(walls);
  Snapshot s = two_rocks_and_water(0.7);
  s.walls = &walls;
  frames.write(s);
  EXPECT_EQ(read_vtp(temporary.path / "walls.vtp")->GetNumberOfPolys(), 12);
  const auto moving = read_vtp(temporary.path / "moving_walls_000000.vtp");
  ASSERT_EQ(moving->GetNumberOfPolys(), 12);
  EXPECT_EQ(moving->GetCellData()->GetArray("wall")->GetComponent(0, 0), 1);
  for (vtkIdType i = 0; i < moving->GetNumberOfPoints(); ++i) {
    const Vec3 x =
        pose_at(*walls[1].motion, 0.7).to_space(walls[1].mesh.vertices[static_cast<std::size_t>(i)]);
    EXPECT_LT((Vec3(moving->GetPoint(i)) - x).norm(), 1e-6);
  }
  // Resuming before a frame drops it; a scene without moving walls has no such series.
  FrameWriter(temporary.path, RockSurface::none, 0.5);
  EXPECT_FALSE(fs::exists(temporary.path / "moving_walls_000000.vtp"));
  walls.pop_back();
  FrameWriter(temporary.path, RockSurface::none, std::nullopt).write(s);
  EXPECT_FALSE(fs::exists(temporary.path / "moving_walls.pvd"));
}

}  // namespace
}  // namespace sluice
