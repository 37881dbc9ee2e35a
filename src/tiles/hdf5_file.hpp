// SPDX-License-Identifier: BSD-3-Clause
// The whole of a folder of tiles in one HDF5 file, tiles.h5.
#pragma once

#include <delone/tiles.hpp>

#include <cstdint>
#include <string>

namespace delone::tiles {

/// Throws unsupported in a build without HDF5: call it before the work begins, too.
void require_hdf5(const std::string& folder);

/// Writes FOLDER/tiles.h5, whole or not at all, from the parts and their seams. With v vertices, n rows and m
/// cells:
///   rows           v          int64    the rows of the input that are vertices, increasing
///   points         v×d        float64  their coordinates
///   weights        v          float64  their weights, if points have weights
///   vertex_of_row  n          int64    for each row the vertex it was merged into; −1: hidden
///   cells          m×(k+1)    int64    rows of the input
///   neighbors      m×(k+1)    int64    cells; −1 beyond the convex hull
/// and the attributes dimension and affine_dimension. Uses about `memory` bytes besides those of one part,
/// and scratch files in WORK. Throws cannot_write, and what reading parts throws.
void write_hdf5(const std::string& folder, const std::string& work, const TilesIndex& index,
                std::uint64_t memory);

}  // namespace delone::tiles
