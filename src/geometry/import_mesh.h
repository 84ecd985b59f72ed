#pragma once
/// CAD files to TriMesh: STL (both kinds) and glTF through assimp, PLY through CGAL, OBJ by our own reader
/// (assimp 5.2 rounds it to float, cuts names at blanks and covers the notch of concave facets); all of them
/// checked by us before and after.
///
/// Parts: an OBJ's `o` (or its `g` where it has no `o`), a text STL's solids, a glTF's nodes with their
/// transforms applied, names whole; else one part named after the file. Equal names are one part. Vertices of
/// exactly the same position are joined. Coordinates stay as they are in the file: a glTF is y-up by its
/// standard and is not turned.

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
