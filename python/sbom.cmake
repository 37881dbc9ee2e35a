# SPDX-License-Identifier: BSD-3-Clause
# The bill of materials of wheels (PEP 770): <build>/python/delone.cdx.json lists in CycloneDX's form the libraries that a wheel has built in
# or beside the module, with their versions. setup.py puts it into wheels. It has neither time nor random number: equal builds have equal files.
find_package(FastFloat QUIET)  # for its version; its headers do not tell
file(READ ${PROJECT_SOURCE_DIR}/viewer/package.json package)
string(JSON three_version GET "${package}" devDependencies three)

set(delone_bill_components "[]")
set(delone_bill_references "[]")

# delone_bill(<name> <repository> <license> <version if fetched> <version if found>)
function(delone_bill name repository license fetched found)
  set(version ${found})
  if(fetched)
    set(version ${fetched})
  endif()
  set(reference "pkg:github/${repository}")
  set(component "{\"type\": \"library\", \"name\": \"${name}\", \"licenses\": [{\"license\": {\"id\": \"${license}\"}}]}")
  if(version)
    string(APPEND reference "@${version}")
    string(JSON component SET "${component}" version "\"${version}\"")
  endif()
  string(JSON component SET "${component}" bom-ref "\"${reference}\"")
  string(JSON component SET "${component}" purl "\"${reference}\"")
  string(JSON count LENGTH "${delone_bill_components}")
  string(JSON components SET "${delone_bill_components}" ${count} "${component}")
  string(JSON references SET "${delone_bill_references}" ${count} "\"${reference}\"")
  set(delone_bill_components "${components}" PARENT_SCOPE)
  set(delone_bill_references "${references}" PARENT_SCOPE)
endfunction()

delone_bill(Highway google/highway Apache-2.0 "${delone_highway_FETCHED}" "${hwy_VERSION}")
if(DELONE_HAVE_TBB)
  delone_bill(oneTBB oneapi-src/oneTBB Apache-2.0 "${delone_tbb_FETCHED}" "${TBB_VERSION}")
endif()
delone_bill(fmt fmtlib/fmt MIT "${delone_fmt_FETCHED}" "${fmt_VERSION}")
delone_bill(nlohmann/json nlohmann/json MIT "${delone_json_FETCHED}" "${nlohmann_json_VERSION}")
delone_bill(fast_float fastfloat/fast_float MIT "${delone_fast_float_FETCHED}" "${FastFloat_VERSION}")
delone_bill(pybind11 pybind/pybind11 BSD-3-Clause "" "${pybind11_VERSION}")
delone_bill(three.js mrdoob/three.js MIT "" "${three_version}")
delone_bill(Boost boostorg/multiprecision BSL-1.0 "${delone_multiprecision_FETCHED}" "${Boost_VERSION_STRING}")

file(CONFIGURE OUTPUT delone.cdx.json @ONLY CONTENT [[{
  "bomFormat": "CycloneDX",
  "specVersion": "1.6",
  "version": 1,
  "metadata": {
    "component": {"type": "library", "bom-ref": "pkg:pypi/delone@@PROJECT_VERSION@", "purl": "pkg:pypi/delone@@PROJECT_VERSION@",
      "name": "delone", "version": "@PROJECT_VERSION@", "licenses": [{"license": {"id": "BSD-3-Clause"}}]}
  },
  "components": @delone_bill_components@,
  "dependencies": [{"ref": "pkg:pypi/delone@@PROJECT_VERSION@", "dependsOn": @delone_bill_references@}]
}
]])
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/delone.cdx.json DESTINATION . COMPONENT wheel EXCLUDE_FROM_ALL)
