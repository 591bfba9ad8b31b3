// References as files: CSV with the columns x,y,z, nx,ny,nz, rho_*, E_*, B_*, se_*, mat, samples, kept for a
// scene so that it is traced once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "report/reference.h"

namespace unshot {

/// Points of a file with at least the columns x,y,z,nx,ny,nz,E_r,E_g,E_b,B_r,B_g,B_b; rho_*, se_*, mat and
/// samples are read where they are there, further ones are read past. Throws Error (kInput, with file:line).
std::vector<ReferencePoint> readReferencePoints(const std::filesystem::path& path);

/// What the points depend on: positions, polygons, rho and E of the scene, emission convention, seed, points
/// or places, and the version of tracer and file. Not names and not the file's place.
std::uint64_t referenceHash(const Scene& scene, const ReferenceOptions& options);

/// "reference-<hash>.csv" in the folder.
std::filesystem::path referencePath(const std::filesystem::path& folder, const Scene& scene,
                                    const ReferenceOptions& options);

/// The reference kept in the folder, traced on where it is not yet as good as asked for, or traced from the
/// start; and kept (the file is replaced by a whole one). A file that is damaged or belongs to something else
/// is not used, a folder that cannot be written to is no failure: both are said in the diagnostics. Throws as
/// traceReference does.
Reference cachedReference(const Scene& scene, const ReferenceOptions& options,
                          const std::filesystem::path& folder);

}  // namespace unshot
