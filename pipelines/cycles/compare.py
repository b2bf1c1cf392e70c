#!/usr/bin/env python3
"""nightview against Blender's Cycles on one CPU: the time each takes to the same relative MSE.

Both render the lamps' light on one baked scene (without lit windows and without lamp posts, which Blender 3.4 cannot read),
direct or with --bounces, through the same camera; errors are those against nightview's reference. Times are CPU seconds summed over
threads, so that whatever else the machine does has no say, and leave out loading, building and compiling on both sides.
Needs blender (pipelines/setup.sh cycles).

  pipelines/cycles/compare.py SCENE.glb --out DIR [--camera street] [--size 480x270] [--threads 2]
"""
import argparse
import json
import math
import os
import re
import shutil
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import lights as city_lights  # noqa: E402
from programs import run  # noqa: E402


def cpu_seconds():
    """Returns the CPU seconds of all processes run so far, summed over their threads."""
    spent = os.times()
    return spent.children_user + spent.children_system


def time_to(error, points):
    """Returns the seconds at which the log-log line through (seconds, error) points reaches `error`. Beyond the last
    point, error is taken to be proportional to 1 / time, as for every Monte Carlo estimate."""
    points = sorted(points)
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e1 <= error <= e0 and e0 > e1:
            share = math.log(e0 / error) / math.log(e0 / e1)
            return t0 * (t1 / t0) ** share
    t, e = points[-1] if error < points[-1][1] else points[0]
    return t * e / error


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--out", required=True)
    parser.add_argument("--nightview", default=os.path.join(HERE, "../../build/release/nightview"))
    parser.add_argument("--camera", default="street", help="preset or file")
    parser.add_argument("--device", default="llvmpipe", help="Vulkan device of nightview")
    parser.add_argument("--size", default="480x270")
    parser.add_argument("--threads", default="2")
    parser.add_argument("--bounces", default="0", help="bounces of light, on both sides")
    parser.add_argument("--samples", default="4,16,64,256", help="samples per pixel of Cycles")
    parser.add_argument("--frames", default="1,4,16,64", help="frames of nightview")
    parser.add_argument("--reference-frames", default="64")
    options = parser.parse_args()
    width, height = options.size.split("x")

    os.makedirs(options.out, exist_ok=True)
    path = lambda name: os.path.join(options.out, name)  # noqa: E731
    glb = path("scene.glb")
    city_lights.without_instances(options.scene, glb)
    shutil.copy(os.path.splitext(options.scene)[0] + ".lights", path("scene.lights"))
    common = [glb, "--size", options.size, "--bounces", options.bounces, "--device", options.device]

    run(options.nightview, "render", *common, "--camera", options.camera, "--estimator", "reference", "--frames",
        options.reference_frames, "--save-camera", path("camera.json"), "-o", path("reference.exr"))

    def error_of(picture):
        figures = json.loads(run(options.nightview, "compare", picture, path("reference.exr"), "--json"))
        return figures["relative_mse"], 1 + figures["relative_mean_signed_error"]

    def render(frames):
        before = cpu_seconds()
        run(options.nightview, "render", *common, "--camera", path("camera.json"), "--frames", str(frames), "-o",
            path(f"nightview-{frames}.exr"))
        return cpu_seconds() - before

    frames = [int(n) for n in options.frames.split(",")]
    most = max(frames) + 1
    a_frame = (render(most) - render(1)) / (most - 1)
    ours = []
    for n in frames:
        render(n)
        error, ratio = error_of(path(f"nightview-{n}.exr"))
        ours.append((n * a_frame, error))
        print(f"nightview {n:>5} frames   {n * a_frame:8.2f} s  relative MSE {error:.4g}  mean ratio {ratio:.4f}", flush=True)

    blender = shutil.which("blender") or sys.exit("blender is not installed: pipelines/setup.sh cycles")
    log = run(blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
              os.path.join(HERE, "render.py"), "--", glb, path("camera.json"), width, height, options.threads,
              options.bounces, path("cycles"), *options.samples.split(","),
              environment={**os.environ, "PATH": os.defpath})  # its Python is the system's, not that of an environment
    theirs = []
    for samples, seconds in re.findall(r"^cycles (\d+) ([0-9.]+)$", log, re.MULTILINE):
        error, ratio = error_of(path(f"cycles-{samples}.exr"))
        theirs.append((float(seconds), error))
        print(f"Cycles    {samples:>5} samples  {float(seconds):8.2f} s  relative MSE {error:.4g}  mean ratio {ratio:.4f}", flush=True)

    for seconds, error in ours:
        needed = time_to(error, theirs)
        print(f"to a relative MSE of {error:.4g}: nightview {seconds:.2f} s, Cycles {needed:.1f} s, ratio {needed / seconds:.1f}")


main()
