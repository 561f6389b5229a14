// SPDX-License-Identifier: Apache-2.0
/// \file
/// The one door to VTK's polygonal data: reading, and polygons to triangles.
#pragma once

#include <string>
#include <vector>

#include "geometry.h"

namespace tetralux::mesher {

/// Reads polygons and triangle strips, or points alone, with their point arrays from `.vtp` or a legacy `.vtk` file.
/// `leftOut`, if given, gets the names of the arrays on polygons, which have no place inside a volume.
/// \throws std::runtime_error naming the file when it is broken.
PolygonSoup readPolyData(const std::string& path, std::vector<std::string>* leftOut = nullptr);

/// Whether a `.vtk` file says that it holds polygonal data.
bool isLegacyPolyData(const std::string& path);

/// Every polygon as triangles (ear cutting; the points stay as they are). Polygons of no area come out as they can.
TriangleSurface triangulatePolygons(const PolygonSoup& soup);

}  // namespace tetralux::mesher
