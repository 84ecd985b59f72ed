#pragma once
/// CAD files to TriMesh: STL (both kinds), OBJ, glTF through assimp, PLY through CGAL, then our own checks.

#include <filesystem>

#include "geometry/tri_mesh.h"

namespace sluice {

/// @param unit_in_metres  length of the file's unit [m]; glTF is in metres by its standard
/// @throws InputError naming the file (and where known the place in it): missing, empty, truncated,
///         non-finite vertices, indices out of range, no triangles, fewer facets than the file states,
///         unknown extension. The caller replaces the location by that of the key that named it, if any.
TriMesh import_mesh(const std::filesystem::path& file, double unit_in_metres);

/// The triangles of one named part. @throws InputError with the names there are, and the nearest
TriMesh extract_part(const TriMesh& mesh, const std::string& part);

/// Wavefront OBJ with one `o` per part, in the unit given; the writer of our own generators.
void write_obj(const std::filesystem::path& file, const TriMesh& mesh, double unit_in_metres,
               const std::string& comment);

}  // namespace sluice
