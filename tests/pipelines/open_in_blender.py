# Opens a .glb in Blender without a window and counts what is in it:
#   blender --background --factory-startup --python open_in_blender.py -- city.glb
# Prints "meshes M triangles T least x y z greatest x y z" in Blender's axes (z up).
import sys

import numpy

# Debian 12's Blender 3.4.1 meets a numpy that has dropped the name its importer uses.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

import bpy

path = sys.argv[sys.argv.index("--") + 1]
bpy.ops.wm.read_factory_settings(use_empty=True)
result = bpy.ops.import_scene.gltf(filepath=path)
if result != {"FINISHED"}:
    sys.exit(f"Blender's importer says {result}")
triangles, least, greatest = 0, [float("inf")] * 3, [float("-inf")] * 3
meshes = [thing for thing in bpy.data.objects if thing.type == "MESH"]
for thing in meshes:
    triangles += sum(len(polygon.vertices) - 2 for polygon in thing.data.polygons)
    for vertex in thing.data.vertices:
        place = thing.matrix_world @ vertex.co
        least = [min(a, b) for a, b in zip(least, place)]
        greatest = [max(a, b) for a, b in zip(greatest, place)]
print("meshes", len(meshes), "triangles", triangles, "least", *(f"{v:.3f}" for v in least), "greatest",
      *(f"{v:.3f}" for v in greatest))
