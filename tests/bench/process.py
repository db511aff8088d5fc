#!/usr/bin/env python3
"""Whole processes, from the scene file to the PNG: trimray on the scene, POV-Ray on the mesh that trimray exports of it.

  process.py TRIMRAY [--size N] SCENE.pov...

Both with one thread. The mesh is made finer until POV-Ray's picture differs from trimray's in at most 0.5 % of the pixels
by more than 1/255. Seconds are the processor's, user and system, the best of three. Prints Markdown."""
import os
import re
import resource
import subprocess
import sys
import tempfile

CHORD_ERRORS = [1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5]
SHARE = 0.005


def processor_seconds(command, cwd):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise RuntimeError(f"{command}: status {done.returncode}\n{done.stdout[-2000:]}")
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def best_seconds(command, cwd, times=3):
    return min(processor_seconds(command, cwd) for _ in range(times))


def differing_share(trimray, a, b):
    said = subprocess.run([trimray, "compare", a, b], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
    found = re.search(r"([0-9.eE+-]+) ?%", said)
    if not found:
        raise RuntimeError(f"compare says: {said}")
    return float(found.group(1)) / 100


def run_scene(trimray, size, scene, work):
    name = os.path.splitext(os.path.basename(scene))[0]
    folder = os.path.dirname(os.path.abspath(scene))
    picture = os.path.join(work, name + ".png")
    switches = [f"+W{size}", f"+H{size}", "+WT1", "-D"]
    ours = best_seconds([trimray, os.path.abspath(scene), *switches, "+O" + picture], folder)
    print(f"| {name} | trimray | | | {ours:.2f} | | |", flush=True)
    for chord_error in CHORD_ERRORS:
        mesh, theirs = os.path.join(work, name + "_mesh.pov"), os.path.join(work, name + "_mesh.png")
        export = processor_seconds([trimray, "export", os.path.abspath(scene), *switches[:2], "-o", mesh,
                                    "--chord-error", str(chord_error)], folder)
        megabytes = os.path.getsize(mesh) / 1e6
        seconds = best_seconds(["povray", "+I" + mesh, "+O" + theirs, *switches, "+L" + folder, "-GA"], work, 1)
        share = differing_share(trimray, picture, theirs)
        print(f"| {name} | POV-Ray, chord error {chord_error:g} | {export:.2f} | {megabytes:.0f} | {seconds:.2f} "
              f"| {100 * share:.2f} % | {seconds / ours:.2f} |", flush=True)
        if share <= SHARE:
            break


def main(arguments):
    trimray, size, scenes = os.path.abspath(arguments[0]), 1024, arguments[1:]
    if scenes[:1] == ["--size"]:
        size, scenes = int(scenes[1]), scenes[2:]
    print("| scene | whole process | export, s | mesh, MB | processor s | pixels that differ | times trimray |")
    print("|---|---|---:|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as work:
        for scene in scenes:
            run_scene(trimray, size, scene, work)


if __name__ == "__main__":
    main(sys.argv[1:])
