#pragma once

// What most users need: meshes in, skeletons out. Each stage's header (curve/find_curve.hpp, refinement/refine.hpp,
// ...) holds that stage; render/, evaluation/ and synth/ are parts of their own; io/openmesh_adaptor.hpp and
// io/cgal_adaptor.hpp need these libraries' headers.

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/skeleton_json.hpp>
#include <skelgen/io/template_json.hpp>
#include <skelgen/io/write_mesh.hpp>
#include <skelgen/version.hpp>
