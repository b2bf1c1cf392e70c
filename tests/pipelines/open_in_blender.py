# Opens a .glb in Blender without a window, and counts meshes and triangles:
#   blender --background --factory-startup --python open_in_blender.py -- city.glb
# Prints "meshes M triangles T min x y z max x y z" in Blender's axes (z up).
import sys

import numpy

# The importer of Debian 12's Blender 3.4.1 uses a name that numpy 1.24 dropped.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

import bpy

path = sys.argv[sys.argv.index("--") + 1]
bpy.ops.wm.read_factory_settings(use_empty=True)
result = bpy.ops.import_scene.gltf(filepath=path)
if result != {"FINISHED"}:
    sys.exit(f"Blender's importer says {result}")
triangles, lower, upper = 0, [float("inf")] * 3, [float("-inf")] * 3
meshes = [thing for thing in bpy.data.objects if thing.type == "MESH"]
for thing in meshes:
    triangles += sum(len(polygon.vertices) - 2 for polygon in thing.data.polygons)
    for vertex in thing.data.vertices:
        place = thing.matrix_world @ vertex.co
        lower = [min(a, b) for a, b in zip(lower, place)]
        upper = [max(a, b) for a, b in zip(upper, place)]
print("meshes", len(meshes), "triangles", triangles, "min", *(f"{v:.3f}" for v in lower), "max",
      *(f"{v:.3f}" for v in upper))
