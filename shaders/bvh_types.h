// The geometry that rays are traced through: nodes of a bounding volume hierarchy (BVH), triangles
// and instances. A mesh that stands in several places has a hierarchy (BLAS) over its triangles, in
// its own frame. A scene has one (TLAS) over the instances of such meshes and, directly, all
// triangles that do not move and are stored where they stand.
#ifndef NIGHTCITY_SHADERS_BVH_TYPES_H
#define NIGHTCITY_SHADERS_BVH_TYPES_H

#include "shaders/shared.h"

#ifdef __cplusplus
namespace nightcity::gpu {
#endif

#define NO_HIT 0xFFFFFFFFu  // no instance, triangle, feature or light

// A node of a BVH: up to four children, their boxes quantised to 8 bits about `origin` with a
// power-of-two step per axis. Boxes are rounded outwards, so that a child's box contains the child.
// 64 bytes: four loads of 16 bytes. (Wide quantised nodes after Ylitie, Karras, Laine: Efficient
// Incoherent Ray Traversal on GPUs, HPG 2017.)
struct BvhNode {
  vec3 origin;
  uint exponents;  // step = 2^(byte - 127) for x, y, z in the low three bytes
  uint lower[3];   // x, y, z: one byte per child
  uint upper[3];
  // BVH_EMPTY, the index of an inner node, or a leaf: of triangles, BVH_LEAF | (count - 1) << 27 |
  // first, or of an instance, BVH_LEAF | BVH_INSTANCE | its index.
  uint child[4];
  // One byte per child: the MASK_* bits of what lies below it. Within a mesh every bit is set;
  // 0 = no child.
  uint masks;
  uint pad;
};
#define BVH_EMPTY 0xFFFFFFFFu
#define BVH_LEAF 0x80000000u
#define BVH_INSTANCE 0x40000000u
#define BVH_LEAF_COUNT_SHIFT 27
#define BVH_LEAF_FIRST_MASK 0x07FFFFFFu  // 134 million triangles
#define BVH_MAX_LEAF 8
// Planes of boxes lie at least this part of a step farther out than what they bound. Traversal
// reads a plane's byte b as 32768 + b: 2^-9 of a step is lost where 32768 steps are taken off
// again, and as much where they are multiplied.
#define BVH_MARGIN 0.0078125f
#define BVH_STACK 96  // entries that a ray may defer; the builder keeps to it

// Three corners in the mesh's own frame, and what they belong to.
struct Triangle {
  vec3 v0;
  uint material;
  vec3 v1;
  uint feature;  // city object, or NO_HIT
  vec3 v2;
  uint light;  // the light whose emitting surface this is, or NO_HIT
};

// One placement of a mesh in the scene.
struct Instance {
  vec4 to_object[3];  // rows of the affine map from model space to the mesh's frame
  // Root node of the mesh's BLAS. Where the device's own structures are traced: the mesh's first
  // triangle.
  uint root;
  uint mask;  // MASK_*
  // The light whose luminous part the instance shows. NO_HIT: the triangles' own lights hold. A
  // vehicle (MASK_VEHICLE): the triangles' lights count from this one.
  uint light;
  uint feature;  // city object; NO_HIT: the triangles' own features hold
};
#define MASK_SHADOW 1u   // stops shadow rays
#define MASK_VISIBLE 2u  // seen by the camera
#define MASK_VEHICLE 4u  // a vehicle, whose triangles' lights count from the instance's

// The instance of triangles that lie in the scene's own hierarchy, where there are any: one whose
// to_object is the identity.
#define STATIC_INSTANCE 0u

// The ground around the scene, to the horizon, which casts no shadow. Its box would make those of
// the scene coarse, so it has a hierarchy of its own, and only rays that may meet it go there.
struct Horizon {
  uint root;  // over its instances, or BVH_EMPTY
  float top;  // no part of it lies higher; model space, m
  vec2 lower, upper;  // x and z of a rectangle that no part of it lies in; lower > upper: none
};

#define TLAS_INSTANCE_WORDS 16u  // 4-byte words of VkAccelerationStructureInstanceKHR

#ifdef __cplusplus
static_assert(sizeof(BvhNode) == 64 && sizeof(Triangle) == 48 && sizeof(Instance) == 64);
}  // namespace nightcity::gpu
#else
// Traversal reads nodes and triangles as 16-byte words: four and three loads.
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Nodes {
  uvec4 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Triangles {
  vec4 at[];
};
#endif
ARRAY_REFERENCE_16(Instances, Instance, readonly)
ARRAY_REFERENCE_16(VehicleInstances, Instance, writeonly)
ARRAY_REFERENCE_16(VehicleBvhNodes, BvhNode, writeonly)

#endif
