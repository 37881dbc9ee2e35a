// SPDX-License-Identifier: BSD-3-Clause
// check() of the triangulation of a periodic set.
#pragma once

#include <delone/check.hpp>
#include <delone/data.hpp>

namespace delone::internal {

CheckReport check_periodic(const ComplexData& data, const CheckOptions& options);

}  // namespace delone::internal
