"""Counts the triangles of a baked scene that Blender shows: those of every node, without the instances of
EXT_mesh_gpu_instancing (newer than Blender 3.4), and of two that lie back to back on the same corners one alone
(Blender's importer validates meshes). Prints the count.
Usage: count_for_blender.py CITY.glb
"""
import json
import struct
import sys

data = open(sys.argv[1], "rb").read()
length = struct.unpack_from("<I", data, 12)[0]
scene = json.loads(data[20 : 20 + length])
start = 20 + length + 8  # of the binary chunk


def read_indices(number):
    accessor = scene["accessors"][number]
    view = scene["bufferViews"][accessor["bufferView"]]
    at = start + view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    letter = {5121: "B", 5123: "H", 5125: "I"}[accessor["componentType"]]
    return struct.unpack_from(f"<{accessor['count']}{letter}", data, at)


def count_shown(mesh):
    shown = 0
    for primitive in mesh["primitives"]:
        indices = read_indices(primitive["indices"])
        corners = zip(indices[0::3], indices[1::3], indices[2::3])
        shown += len({tuple(sorted(triangle)) for triangle in corners})
    return shown


shown = [count_shown(mesh) for mesh in scene["meshes"]]
print(sum(shown[node["mesh"]] for node in scene["nodes"] if "mesh" in node))
