"""Reads from city.lights (formats/SPEC.md, section 3) what Blender needs, with the standard library alone."""
import json
import struct
from dataclasses import dataclass


REFINEMENT = 16  # angles of a profile for Cycles for each of its own


@dataclass
class Light:
    position: tuple
    radius: float
    axis: tuple
    half_height: float
    tangent: tuple
    flux_lm: float
    colour: tuple  # linear Rec. 709, luminance 1
    kind: int  # 0 sphere, 1 rectangle
    profile: int  # or -1
    scheduled: bool
    identity: int


@dataclass
class Profile:
    extent_deg: float
    rows: list  # one list of candela per lumen for each C plane


def _colour(packed):
    scale = 2.0 ** ((packed >> 27) - 24)
    rgb = [scale * (packed >> shift & 511) for shift in (0, 9, 18)]
    y = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
    return tuple(c / y for c in rgb)


def read(path):
    """Returns (lights, profiles). Raises ValueError when the file is not a city.lights of major version 1."""
    with open(path, "rb") as file:
        data = file.read()
    magic, major, _, count, size, table = struct.unpack_from("<8sHHIQQ", data)
    if magic != b"NCLIGHTS" or major != 1 or size != len(data):
        raise ValueError(f"{path}: not a whole city.lights of version 1")
    sections = {}
    for i in range(count):
        tag, element, offset, elements, _ = struct.unpack_from("<4sIQQQ", data, table + 32 * i)
        sections[tag.decode()] = (element, offset, elements)

    lights = []
    element, offset, elements = sections["LGHT"]
    for i in range(elements):
        f = struct.unpack_from("<3f f 3f f 3f f I I I I", data, offset + i * element)
        profile = f[13] >> 8
        lights.append(Light(f[0:3], f[3], f[4:7], f[7], f[8:11], f[11], _colour(f[12]), f[13] & 255,
                            -1 if profile == 0xFFFFFF else profile, f[14] != 0xFFFFFFFF, f[15]))

    profiles = []
    values_at = sections["PDAT"][1]
    element, offset, elements = sections["PROF"]
    for i in range(elements):
        planes, gammas, first, extent = struct.unpack_from("<IIIf", data, offset + i * element)
        values = struct.unpack_from(f"<{planes * gammas}f", data, values_at + 4 * first)
        profiles.append(Profile(extent, [list(values[c * gammas:(c + 1) * gammas]) for c in range(planes)]))
    return lights, profiles


def keep_on(lights, point, first, last, path):
    """Writes edits (formats/SPEC.md, section 5) that leave on only the lights from the `first` nearest to `point` to the `last`, from 1 on."""
    def distance(light):
        return sum((a - b) ** 2 for a, b in zip(light.position, point))

    nearest = sorted(lights, key=distance)
    off = nearest[:first - 1] + nearest[last:]
    with open(path, "w") as file:
        json.dump({"version": 1, "lights": [{"id": f"{light.identity:08x}", "off": True} for light in off]}, file)


def read_switched_off(path):
    """Returns the identities of the lights that the edits at `path` switch off; none where there is no such file."""
    try:
        with open(path) as file:
            return {int(light["id"], 16) for light in json.load(file)["lights"] if light.get("off")}
    except FileNotFoundError:
        return set()


def _refined(values, wraps):
    """Returns `values`, numbers or lists of them, with REFINEMENT - 1 more between each two, on the line between them."""
    def between(a, b, share):
        return [between(x, y, share) for x, y in zip(a, b)] if isinstance(a, list) else a + (b - a) * share

    ends = values[1:] + values[:1] if wraps else values[1:]
    refined = [between(a, b, i / REFINEMENT) for a, b in zip(values, ends) for i in range(REFINEMENT)]
    return refined if wraps else refined + values[-1:]


def as_ies(profile):
    """Returns the profile as an IES LM-63-2002 text, in candela per 1000 lumens. It has more angles than the profile: Cycles
    draws cubic curves through them where a city.lights is bilinear."""
    rows = _refined(profile.rows, True) if len(profile.rows) > 1 else profile.rows
    profile = Profile(profile.extent_deg, [_refined(row, False) for row in rows])
    gammas = len(profile.rows[0])
    step = profile.extent_deg / (gammas - 1)
    angles = [g * step for g in range(gammas)]
    if profile.extent_deg < 180:  # the format requires an explicit dark row beyond
        angles += [min(180.0, profile.extent_deg + 1e-3), 180.0]
    planes = profile.rows + [profile.rows[0]] if len(profile.rows) > 1 else profile.rows
    turns = [360.0 * c / len(profile.rows) for c in range(len(planes))]
    lines = ["IESNA:LM-63-2002", "TILT=NONE", f"1 1000 1 {len(angles)} {len(planes)} 1 2 0 0 0", "1 1 0",
             " ".join(f"{a:.6g}" for a in angles), " ".join(f"{t:.6g}" for t in turns)]
    for row in planes:
        candela = [1000 * v for v in row] + [0.0] * (len(angles) - gammas)
        lines.append(" ".join(f"{v:.6g}" for v in candela))
    return "\n".join(lines) + "\n"


def without_instances(glb, out):
    """Copies a .glb without the nodes that use EXT_mesh_gpu_instancing, which Blender 3.4 does not know."""
    with open(glb, "rb") as file:
        data = file.read()
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20:20 + length])
    for node in document.get("nodes", []):
        if "EXT_mesh_gpu_instancing" in node.get("extensions", {}):
            node.pop("mesh", None)
            del node["extensions"]
    for member in ("extensionsUsed", "extensionsRequired"):
        if member in document:
            document[member] = [e for e in document[member] if e != "EXT_mesh_gpu_instancing"]
            if not document[member]:
                del document[member]
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length:]
    with open(out, "wb") as file:
        file.write(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest)
