#!/usr/bin/env python3
"""Tests whether nightview's reference and Blender's Cycles show the same picture of a baked scene, in its mean and pixel by pixel.

Both render the lamps' light on one scene (as compare.py does: without lit windows and lamp posts), several times with
independent random numbers. The means of the runs are compared by Welch's test: in the mean of the picture, and in each pixel
with Sidak's correction for their number at a joint level of 1 %. Ends with 1 where a pixel is beyond noise, or the mean is
off by more than --tolerance and three standard errors. Pictures that lie in --out already are not rendered again, so that
more runs can be added, or brought from another machine.
Needs blender and OpenImageIO (pipelines/setup.sh cycles).

  pipelines/cycles/agree.py SCENE.glb --out DIR --bounces 4 [--camera street] [--size 96x54] [--runs 16] [--samples 2048]
"""
import argparse
import glob
import json
import math
import os
import shutil
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import numpy  # noqa: E402
import OpenImageIO  # noqa: E402

import lights as city_lights  # noqa: E402
from programs import run  # noqa: E402

LUMINANCE = numpy.array((0.2126, 0.7152, 0.0722))  # of linear Rec. 709


def lamp_range(text):
    """Returns the first and the last of the lamps that `text` names, FIRST-LAST or LAST, counted from 1."""
    first, last = map(int, text.split("-")) if "-" in text else (1, int(text))
    if not 1 <= first <= last:
        raise ValueError(text)
    return first, last


def read_luminance(path):
    """Returns the luminance of each pixel, cd/m2, as rows of a 2D array."""
    picture = OpenImageIO.ImageInput.open(path) or sys.exit(f"{path}: {OpenImageIO.geterror()}")
    names = picture.spec().channelnames
    channels = [names.index(name) for name in "RGB"]
    return picture.read_image("float")[:, :, channels] @ LUMINANCE


def read_runs(pattern):
    """Returns the luminance of the pictures that match `pattern`: runs x rows x columns."""
    return numpy.stack([read_luminance(path) for path in sorted(glob.glob(pattern))]).astype(float)


def normal_quantile(level):
    """Returns z such that a standard normal variable lies in [-z, z] with the probability `level`."""
    low, high = 0.0, 40.0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if math.erf(middle / math.sqrt(2)) < level else (low, middle)
    return high


def test_agreement(ours, theirs, tolerance, pixel_tolerance):
    """Prints how far the means of the runs are apart, and returns whether they agree."""
    means = [runs.mean(axis=(1, 2)) for runs in (ours, theirs)]
    truth = means[0].mean()
    difference = means[1].mean() / truth - 1
    error = math.sqrt(sum(m.var(ddof=1) / len(m) for m in means)) / truth
    print(f"mean: nightview {truth:.6g} cd/m2, Cycles {100 * difference:+.3f} % +- {100 * error:.3f} %"
          f" ({len(ours)} and {len(theirs)} runs)")

    variance = sum(runs.var(axis=0, ddof=1) / len(runs) for runs in (ours, theirs))
    gap = theirs.mean(axis=0) - ours.mean(axis=0)
    gap = numpy.sign(gap) * numpy.maximum(abs(gap) - pixel_tolerance * ours.mean(axis=0), 0)
    z = numpy.where(variance > 0, gap / numpy.sqrt(numpy.maximum(variance, 1e-300)), 0)
    limit = normal_quantile(0.99 ** (1 / z.size))
    beyond = int((abs(z) > limit).sum())
    print(f"pixels: {beyond} of {z.size} beyond noise (|z| > {limit:.2f}; greatest {abs(z).max():.2f});"
          f" standard deviation of z {z.std():.2f}; median standard error of a pixel"
          f" {100 * numpy.median(numpy.sqrt(variance) / numpy.maximum(ours.mean(axis=0), 1e-9)):.2f} %")
    for y, x in zip(*numpy.nonzero(abs(z) > limit)):
        print(f"  pixel {x},{y}: nightview {ours[:, y, x].mean():.5g}, Cycles {theirs[:, y, x].mean():.5g} cd/m2, z {z[y, x]:+.1f}")
    return beyond == 0 and abs(difference) <= max(tolerance, 3 * error)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--out", required=True)
    parser.add_argument("--nightview", default=os.path.join(HERE, "../../build/release/nightview"))
    parser.add_argument("--device", default="llvmpipe", help="Vulkan device of nightview")
    parser.add_argument("--camera", default="street", help="preset or file")
    parser.add_argument("--lamps", type=lamp_range, help="lamps that stay on, counted from where the camera looks: 8 means the nearest"
                        " eight, 9-40 those after them; Cycles picks one of all lamps at every vertex, so that among hundreds it needs"
                        " millions of samples a pixel")
    parser.add_argument("--size", default="96x54")
    parser.add_argument("--bounces", default="4")
    parser.add_argument("--threads", default="2")
    parser.add_argument("--runs", type=int, default=16, help="independent runs of Cycles")
    parser.add_argument("--samples", default="2048", help="samples per pixel of a run of Cycles")
    parser.add_argument("--reference-runs", type=int, default=8, help="independent runs of nightview's reference")
    parser.add_argument("--reference-frames", default="64", help="frames of each of them")
    parser.add_argument("--tolerance", type=float, default=0.005, help="what the mean may be off by, as a share")
    parser.add_argument("--pixel-tolerance", type=float, default=0.01, help="the same of a pixel, beside noise: Cycles reads profiles"
                        " with other curves between their angles")
    options = parser.parse_args()
    width, height = options.size.split("x")

    os.makedirs(options.out, exist_ok=True)
    path = lambda name: os.path.join(options.out, name)  # noqa: E731
    scene = path("scene.glb")
    if not os.path.exists(scene):
        city_lights.without_instances(options.scene, scene)
        shutil.copy(os.path.splitext(options.scene)[0] + ".lights", path("scene.lights"))
    common = [scene, "--size", options.size, "--device", options.device]
    if not os.path.exists(path("camera.json")):
        run(options.nightview, "render", *common, "--camera", options.camera, "--frames", "1", "--save-camera", path("camera.json"),
            "-o", path("first.exr"))
    if options.lamps:
        with open(path("camera.json")) as file:
            target = json.load(file)["target"]
        city_lights.keep_on(city_lights.read(path("scene.lights"))[0], target, *options.lamps, path("scene.edits.json"))
        common += ["--edits", path("scene.edits.json")]
    for seed in range(1, options.reference_runs + 1):
        if not os.path.exists(path(f"reference-{seed}.exr")):
            run(options.nightview, "render", *common, "--camera", path("camera.json"), "--bounces", options.bounces, "--no-jitter", "--estimator",
                "reference", "--frames", options.reference_frames, "--seed", str(seed), "-o", path(f"reference-{seed}.exr"))
    missing = [f"{options.samples}:{seed}" for seed in range(1, options.runs + 1)
               if not os.path.exists(path(f"cycles-{options.samples}-{seed}.exr"))]
    if missing:
        blender = shutil.which("blender") or sys.exit("blender is not installed: pipelines/setup.sh cycles")
        run(blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python", os.path.join(HERE, "render.py"),
            "--", scene, path("camera.json"), width, height, options.threads, options.bounces, path("cycles"), *missing,
            environment={**os.environ, "PATH": os.defpath})  # its Python is the system's, not that of an environment

    agree = test_agreement(read_runs(path("reference-*.exr")), read_runs(path(f"cycles-{options.samples}-*.exr")), options.tolerance,
                           options.pixel_tolerance)
    sys.exit(0 if agree else 1)


main()
