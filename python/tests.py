"""Tests of the Python package: `python3 tests.py`, with the package importable. They need only numpy.

If trimesh, pyvista and meshio are installed, the tests draw their meshes, too.
"""

import ast
import contextlib
import copy
import gzip
import importlib.util
import io
import json
import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest
import warnings
import zlib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
# The package beside this file may not be built. The tests use the installed one, or the one on PYTHONPATH.
if pathlib.Path(sys.path[0]).resolve() == HERE:
    del sys.path[0]

import fastphong as fp  # noqa: E402

ROOT = HERE.parent
SIZE = (96, 72)

#: A cube of quads, counter-clockwise as seen from outside.
CUBE = (
    np.array([(x, y, z) for x in (-1.0, 1) for y in (-1.0, 1) for z in (-1.0, 1)]),
    np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]),
)


def triangles(faces):
    """Return quads cut into triangles."""
    return np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])


def sphere(rings=12, segments=24):
    """Return the vertices and triangles of a sphere around the z axis. No two vertices coincide."""
    polar = np.pi * np.arange(1, rings) / rings
    azimuth = 2 * np.pi * np.arange(segments) / segments
    p, a = np.meshgrid(polar, azimuth, indexing="ij")
    around = np.stack([np.sin(p) * np.cos(a), np.sin(p) * np.sin(a), np.cos(p)], axis=-1).reshape(-1, 3)
    vertices = np.concatenate([[(0, 0, 1)], around, [(0, 0, -1)]])
    faces = []
    for s in range(segments):
        t = (s + 1) % segments
        faces.append((0, 1 + s, 1 + t))
        for r in range(rings - 2):
            a, b = 1 + r * segments, 1 + (r + 1) * segments
            faces += [(a + s, b + s, b + t), (a + s, b + t, a + t)]
        last = 1 + (rings - 2) * segments
        faces.append((last + s, len(vertices) - 1, last + t))
    return vertices, np.array(faces)


def measured(mesh, method="auto", **arguments):
    """Draw a mesh for measuring: linear levels on a transparent background."""
    return fp.render(mesh, method, **{"size": SIZE, "look": "compared", **arguments})


def drawn(picture):
    """Return which pixels differ from the corner, where nothing is drawn."""
    return (np.asarray(picture) != np.asarray(picture)[0, 0]).any(axis=2)


def told(draw):
    """Return the warnings that `draw()` raises, and check that they point to this file."""
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        draw()
    for warning in found:
        assert pathlib.Path(warning.filename).resolve() == pathlib.Path(__file__).resolve(), warning.filename
    return [str(warning.message) for warning in found]


def same(test, a, b):
    """Fail unless two pictures are equal, byte by byte."""
    test.assertEqual(a.shape, b.shape)
    test.assertTrue((np.asarray(a) == np.asarray(b)).all(), repr(fp.diff(a, b)))


def forked(work):
    """Run `work` in a child of this process. Return 0 if it worked, or `None` if it waits for ever."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        try:
            work()
            os._exit(0)
        finally:
            os._exit(1)
    for _ in range(600):
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            return status
        time.sleep(0.1)
    os.kill(child, 9)
    os.waitpid(child, 0)
    return None


class Pictures(unittest.TestCase):
    def test_a_picture_is_an_array_that_may_be_written_to(self):
        picture = fp.render("builtin:sphere", size=SIZE)
        self.assertIsInstance(picture, np.ndarray)
        self.assertEqual((picture.shape, picture.dtype), ((72, 96, 4), np.dtype(np.uint8)))
        self.assertTrue(picture.flags.writeable and picture.flags.c_contiguous)
        picture[:] = 7
        self.assertTrue((picture == 7).all())
        # The numpy array shares its memory with the bytes that were drawn into.
        base = picture
        while isinstance(base, np.ndarray):
            base = base.base
        self.assertIsInstance(memoryview(base).obj if isinstance(base, memoryview) else base, bytearray)

    def test_notebooks_get_a_png(self):
        picture = fp.render("builtin:sphere", size=SIZE)
        self.assertTrue(picture._repr_png_().startswith(b"\x89PNG\r\n"))
        self.assertTrue(picture[10:40, 20:60]._repr_png_().startswith(b"\x89PNG\r\n"))
        for part in (picture[..., 0], picture[:0], picture.astype(float), picture[..., :3]):
            self.assertIsNone(part._repr_png_())

    def test_numpy_results_are_pictures_only_if_they_have_their_shape(self):
        picture = fp.render("builtin:sphere", size=SIZE)
        for result in (picture[10:40], picture.copy(), np.hstack([picture, picture]), picture // 2,
                       np.concatenate([picture, np.zeros_like(picture)]), np.where(picture > 9, picture, 0)):
            self.assertIsInstance(result, fp.Picture)
        for result in (picture + 0.5, picture == picture, np.asarray(picture), picture.astype(int) - 1):
            self.assertIs(type(result), np.ndarray)
        self.assertIs(type(picture.max()), np.uint8)
        self.assertIs(type(picture.mean()), np.float64)

    def test_a_saved_picture_is_read_unchanged(self):
        picture = fp.render("builtin:sphere", size=SIZE, samples=2)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "a picture.png")
            picture.save(path)
            same(self, fp.read_picture(path), picture)
            self.assertEqual(path.read_bytes()[:4], b"\x89PNG")
            self.assertTrue(fp.diff(path, picture).equal)
            with self.assertRaisesRegex(ValueError, "expected .png, .ppm or .pfm"):
                picture.save(pathlib.Path(folder, "a.jpg"))
            with self.assertRaises(FileNotFoundError):
                picture.save(pathlib.Path(folder, "none", "a.png"))
            with self.assertRaises(FileNotFoundError):
                fp.read_picture(pathlib.Path(folder, "none.png"))
            path.write_bytes(b"nothing")
            with self.assertRaisesRegex(ValueError, "not a picture that can be read"):
                fp.read_picture(path)

    def test_files_without_alpha_show_the_picture_over_its_background(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.ppm")
            clear = measured("builtin:sphere", samples=4, scene={"image": {"background": (0, 0.5, 1)}})
            solid = measured("builtin:sphere", samples=4, background=(0, 0.5, 1))
            self.assertEqual((clear.background, solid.background), ((0, 128, 255), None))
            clear.save(path)
            # The edge is rounded before it is put over the background, and the background, too: half a level each.
            found = fp.diff(solid[..., :3], path, assume="linear")
            self.assertLessEqual(found.max, 1)
            self.assertGreater(int((clear[..., 3] % 255 > 0).sum()), 100)

    def test_results_of_numpy_keep_the_encoding_of_their_pictures(self):
        linear, shown = measured("builtin:sphere"), fp.render("builtin:sphere", size=SIZE)
        self.assertEqual((linear.encoding, shown.encoding), ("linear", "srgb"))
        for result in (linear[10:40], linear.copy(), np.hstack([linear, linear]), linear // 2):
            self.assertEqual(result.encoding, "linear")
        self.assertIsNone(np.hstack([linear, shown]).encoding)
        self.assertIsNone(np.zeros_like(shown, shape=(4, 4, 4)).view(np.ndarray).view(fp.Picture).encoding)

    def test_a_background_makes_pictures_opaque(self):
        plain = measured("builtin:sphere")
        white = measured("builtin:sphere", background=1)
        blue = measured("builtin:sphere", background=(0, 0, 1), samples=2)
        self.assertEqual(tuple(white[0, 0]), (255, 255, 255, 255))
        self.assertTrue((blue[..., 3] == 255).all())
        covered = plain[..., 3] == 255
        self.assertTrue((white[covered] == plain[covered]).all() and (white[~covered] == 255).all())

    def test_a_mesh_is_shown_or_compared(self):
        shown, compared = fp.render("builtin:sphere", size=SIZE), measured("builtin:sphere")
        self.assertTrue((shown[..., 3] == 255).all())
        self.assertTrue(shown[0, 0].all())
        self.assertEqual(tuple(compared[0, 0]), (0, 0, 0, 0))
        self.assertEqual(set(np.unique(compared[..., 3])), {0, 255})
        self.assertEqual(compared[36, 48, 3], 255)
        same(self, shown, fp.render("builtin:sphere", size=SIZE, samples=2, look="shown"))
        same(self, fp.render("football", size=SIZE), measured("football"))
        with self.assertRaisesRegex(ValueError, "`look` is `bright`: expected shown or compared"):
            fp.render("builtin:sphere", look="bright")

    def test_arguments_override_the_look(self):
        # Each argument replaces one part of the look, and the others stay.
        plain = fp.render("builtin:sphere", size=SIZE)
        white = fp.render("builtin:sphere", size=SIZE, background=1)
        self.assertEqual(tuple(white[0, 0]), (255, 255, 255, 255))
        self.assertTrue((white[36, 48] == plain[36, 48]).all())
        rough = fp.render("builtin:sphere", size=SIZE, samples=1)
        self.assertLess(len(np.unique(rough.reshape(-1, 4), axis=0)), len(np.unique(plain.reshape(-1, 4), axis=0)))
        dark = fp.render("builtin:sphere", size=SIZE, light=[])
        self.assertTrue((dark[0, 0] == plain[0, 0]).all())
        self.assertLess(int(dark.max(axis=(0, 1))[0]), int(plain.max(axis=(0, 1))[0]))

    @unittest.skipUnless(os.environ.get("FASTPHONG_PROGRAM"), "FASTPHONG_PROGRAM names no program")
    def test_pictures_equal_the_programs(self):
        vertices, quads = CUBE
        facets = np.zeros(12, np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")]))
        facets["corners"] = vertices[triangles(quads)]
        lines = ["%g %g %g" % tuple(vertex) for vertex in vertices]
        files = {
            "cube.stl": b"\0" * 80 + np.uint32(12).tobytes() + facets.tobytes(),
            "cube.mtl": b"newmtl a\nKd 0.8 0.2 0.1\nKs 0.5 0.5 0.5\nNs 20\nnewmtl b\nKd 0.1 0.2 0.8\n",
            "cube.obj": "\n".join(
                ["mtllib cube.mtl", *(f"v {line}" for line in lines), "usemtl a",
                 *("f %d %d %d %d" % tuple(quad + 1) for quad in quads[:3]), "usemtl b",
                 *("f %d %d %d %d" % tuple(quad + 1) for quad in quads[3:])]).encode(),
            "cube.ply": "\n".join(
                ["ply", "format ascii 1.0", "element vertex 8", *(f"property float {axis}" for axis in "xyz"),
                 *(f"property uchar {colour}" for colour in ("red", "green", "blue")),
                 "element face 6", "property list uchar int vertex_indices", "end_header",
                 *(f"{line} {40 * i % 256} {90 * i % 256} {130 * i % 256}" for i, line in enumerate(lines)),
                 *("4 %d %d %d %d" % tuple(quad) for quad in quads)]).encode(),
        }
        with tempfile.TemporaryDirectory() as folder:
            for name, content in files.items():
                pathlib.Path(folder, name).write_bytes(content)
            paths = [os.path.join(folder, name) for name in ("cube.stl", "cube.obj", "cube.ply")]
            for mesh in (*paths, "builtin:teapot", "football"):
                for arguments, flags in (
                    ({}, []),
                    ({"size": (96, 72)}, ["--size", "96x72"]),
                    ({"size": (131, 67), "view": (200, 35)}, ["--size", "131x67", "--view", "200,35"]),
                    ({"size": (96, 72), "up": "z", "fovy": 40}, ["--size", "96x72", "--up", "z", "--fovy", "40"]),
                    ({"size": (96, 72), "background": 1, "samples": 4},
                     ["--size", "96x72", "--background", "1", "--samples", "4", "--alpha", "opaque"]),
                    ({"size": (96, 72), "light": (1, 0, 0), "normals": 30, "weld": 0.01},
                     ["--size", "96x72", "--light", "1,0,0", "--normals", "crease=30", "--weld", "0.01"]),
                    ({"size": (96, 72), "scene": {"material": {"kd": 0.3}, "ambient": 2}},
                     ["--size", "96x72", "--kd", "0.3", "--ambient", "2"]),
                    ({"size": (48, 36), "method": "reference"}, ["--size", "48x36", "--method", "reference"]),
                ):
                    with self.subTest(f"{mesh} {arguments}"):
                        shown = os.path.join(folder, "shown.png")
                        program = os.environ["FASTPHONG_PROGRAM"]
                        subprocess.run([program, "--quiet", "render", mesh, "-o", shown, "--force", *flags], check=True)
                        own = os.path.join(folder, "own.png")
                        with warnings.catch_warnings():
                            warnings.simplefilter("ignore")
                            fp.render(mesh, **arguments).save(own)
                        # The files are the same, also in what they state.
                        self.assertEqual(pathlib.Path(own).read_bytes(), pathlib.Path(shown).read_bytes())

    @unittest.skipUnless(os.environ.get("FASTPHONG_PROGRAM"), "FASTPHONG_PROGRAM names no program")
    def test_random_worlds_are_the_programs(self):
        # `cargo test --test worlds` writes them.
        worlds = sorted((ROOT / "target" / "tmp" / "worlds").glob("*/world.toml"))
        if not worlds:
            self.skipTest("there are no random worlds")
        drawn = 0
        with tempfile.TemporaryDirectory() as folder:
            shown, own, plain = (pathlib.Path(folder, name) for name in ("shown.png", "own.png", "plain.obj"))
            for path in worlds:
                with self.subTest(path.parent.name):
                    command = [os.environ["FASTPHONG_PROGRAM"], "render", path, "-o", shown, "--force"]
                    ran = subprocess.run(command, capture_output=True, text=True)
                    said = [line for line in ran.stderr.splitlines() if line.startswith("warning: ")]
                    if ran.returncode != 0:
                        with self.assertRaises(ValueError) as refused:
                            fp.render(path)
                        self.assertIn(str(refused.exception).split(": ")[0], ran.stderr)
                        continue
                    self.assertEqual(len(told(lambda: fp.render(path).save(own))), len(said), ran.stderr)
                    self.assertEqual(own.read_bytes(), shown.read_bytes())
                    drawn += 1
                    mesh = path.with_name("world.obj")
                    if mesh.stat().st_size:
                        self.check_arrays(mesh, plain)
        # If most were refused, the test would show little.
        self.assertGreater(2 * drawn, len(worlds))

    def check_arrays(self, path, plain):
        """Check that arrays draw what a file of these arrays draws, and that pickled meshes draw what the file draws."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                mesh = fp.Mesh(path)
            except ValueError:
                return
            draw = lambda mesh: fp.render(mesh, size=(48, 36), view=(20, 30), normals=50)
            vertices, faces = mesh.vertices, mesh.faces
            plain.write_text("".join("v %r %r %r\n" % tuple(map(float, vertex)) for vertex in vertices)
                             + "".join("f " + " ".join(str(corner + 1) for corner in face) + "\n" for face in faces))
            try:
                expected = draw(plain)
            except ValueError:
                with self.assertRaises(ValueError):
                    draw((vertices, faces))
                return
            same(self, draw((vertices, faces)), expected)
            same(self, draw(pickle.loads(pickle.dumps(mesh))), draw(path))

    def test_pictures_equal_those_that_the_project_stores(self):
        kept = ROOT / "tests" / "references"
        if not kept.is_dir():
            self.skipTest("the project's pictures are not here")
        for scene in ("teapot", "football", "perspective", "local-lights"):
            reference = fp.read_picture(kept / scene / "reference-phong.png")
            size = reference.shape[1::-1]
            # A stored picture may differ from a drawn one by a level, because both are rounded.
            fp.diff(reference, fp.render(scene, "reference", size=size)).assert_below(1.5)
            fp.diff(reference, fp.render(scene, "naive-phong", size=size)).assert_below(2.5)


class Meshes(unittest.TestCase):
    def test_a_mesh_draws_the_same_picture_in_every_form(self):
        vertices, quads = CUBE
        cube = fp.render(CUBE, size=SIZE)
        self.assertGreater(int(drawn(cube).sum()), 1000)
        for mesh in (
            list(CUBE),
            (vertices.tolist(), quads.tolist()),
            (vertices, [tuple(quad) for quad in quads]),
            (vertices, list(quads)),
            fp.Mesh(vertices, quads),
            fp.Mesh(fp.Mesh(CUBE)),
        ):
            same(self, fp.render(mesh, size=SIZE), cube)

    def test_any_kind_of_numbers_is_accepted(self):
        vertices, quads = CUBE
        cube = fp.render(CUBE, size=SIZE)
        padded = np.zeros((16, 6))
        padded[::2, ::2] = vertices
        frozen = vertices.copy()
        frozen.flags.writeable = False
        for other in (vertices.astype("<f4"), vertices.astype(">f8"), vertices.astype(np.int8),
                      np.asfortranarray(vertices), padded[::2, ::2], vertices[::-1].copy()[::-1], frozen):
            same(self, fp.render((other, quads), size=SIZE), cube)
        for other in (quads.astype(np.int32), quads.astype(np.uint8), quads.astype(">i8"), quads.astype(np.uint64),
                      np.asfortranarray(quads), quads[::-1].copy()[::-1]):
            same(self, fp.render((vertices, other), size=SIZE), cube)

    def test_faces_may_have_any_number_of_corners(self):
        vertices, quads = CUBE
        mixed = [*quads[:3], *triangles(quads[3:])]
        mesh = fp.Mesh(vertices, mixed)
        self.assertEqual([len(face) for face in mesh.faces], [4, 4, 4, 3, 3, 3, 3, 3, 3])
        self.assertEqual(repr(mesh), "<Mesh: 8 vertices, 9 faces>")
        # A cube with flat faces looks the same however its faces are cut.
        flat = fp.render(mesh, "flat", size=SIZE)
        same(self, flat, fp.render(CUBE, "flat", size=SIZE))
        self.assertTrue((fp.Mesh(CUBE).faces == quads).all())
        self.assertTrue((fp.Mesh(CUBE).vertices == vertices).all())

    def test_errors_in_arrays_name_the_row(self):
        vertices, quads = CUBE
        nan = vertices.copy()
        nan[5, 1] = np.nan
        far = quads.copy()
        far[2, 3] = 8
        negative = quads.copy()
        negative[4, 0] = -1
        for mesh, kind, text in (
            ((nan, quads), ValueError, r"vertices: row 5 is \(1, nan, 1\): expected finite numbers"),
            ((vertices[:, :2], quads), ValueError, r"vertices: an array of shape \(8, 2\): expected \(n, 3\)"),
            ((vertices + 1j, quads), TypeError, "vertices: an array of complex128: expected numbers"),
            (([["a", "b", "c"]], quads), TypeError, "vertices: an array of .*: expected numbers"),
            ((vertices, far), IndexError, "faces: row 2 has the index 8: expected 0 to 7"),
            ((vertices, negative), IndexError, "faces: row 4 has the index -1: expected 0 to 7"),
            ((vertices, [(0, 1, 2), (0, 1, 2, 9)]), IndexError, "faces: row 1 has the index 9"),
            ((vertices, [(0, 1, 2), (0, 1)]), ValueError, "faces: row 1 has 2 corners: expected three or more"),
            ((vertices, quads[:, :2]), ValueError, r"faces: an array of shape \(6, 2\)"),
            ((vertices, quads.astype(float)), TypeError, "faces: indices of float64: expected whole numbers"),
            ((vertices, quads == 0), TypeError, "faces: indices of bool"),
            ((vertices, [1, 2, 3]), TypeError, "faces: expected rows of indices"),
            ((1e300 * vertices, quads), ValueError, "vertices: row 0 is .*: expected finite numbers up to 3.4e38"),
            ((np.zeros((0, 3)), quads), IndexError, "faces: row 0 has the index 0: there are no vertices"),
            ((vertices, quads, vertices[:3]), ValueError, "normals: 3 rows: expected one for each of 8 vertices"),
            ((vertices, quads, nan), ValueError, "normals: row 5 is"),
            ((vertices,), TypeError, "a mesh of 1 parts"),
            (7, TypeError, "builtins.int is no mesh"),
            (None, TypeError, "builtins.NoneType is no mesh"),
        ):
            with self.subTest(text), self.assertRaisesRegex(kind, text):
                fp.render(mesh, size=SIZE)

    def test_arrays_of_every_kind_are_read(self):
        vertices, quads = CUBE
        cube = fp.render(CUBE, size=SIZE)

        class Array:
            def __init__(self, array):
                self.array = array

            def __array__(self, dtype=None, copy=None):
                return self.array

        mixed = np.empty(6, object)
        mixed[:] = [list(quad) for quad in quads]
        for mesh in ((Array(vertices), Array(quads)), (np.ma.array(vertices), np.ma.array(quads)),
                     (vertices.astype(object), quads.astype(object)), (vertices, mixed), (vertices, Array(mixed)),
                     (vertices, (tuple(quad) for quad in quads))):
            same(self, fp.render(mesh, size=SIZE), cube)
        hidden = np.ma.masked_array(vertices, np.zeros((8, 3), bool))
        hidden[3, 1] = np.ma.masked
        for mesh, text in (
            ((hidden, quads), "vertices: row 3 has a masked entry"),
            ((vertices, np.ma.masked_equal(quads, 6)), "faces: row 1 has a masked entry"),
            # What stands under the mask does not matter.
            ((vertices, np.ma.masked_equal(np.where(quads == 6, -1, quads), -1)), "faces: row 1 has a masked entry"),
            ((vertices, list(np.ma.masked_equal(quads, 6))), "faces: row 1 has a masked entry"),
            ((vertices, quads, hidden), "normals: row 3 has a masked entry"),
            (([[1, 2, 3], [1, 2]], quads), "vertices: .*inhomogeneous"),
            ((vertices, quads, [[1, 2, 3], [1, 2]]), "normals: .*inhomogeneous"),
        ):
            with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                fp.render(mesh, size=SIZE)
        with self.assertRaisesRegex(ValueError, "colours: row 3 has a masked entry"):
            fp.Mesh(vertices, quads, colours=hidden)

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "pandas is not installed")
    def test_pandas_itself(self):
        import pandas
        vertices, quads = CUBE
        cube = fp.render(CUBE, size=SIZE)
        tables = pandas.DataFrame(vertices, columns=list("xyz")), pandas.DataFrame(quads)
        for mesh in (tables, (tables[0].astype("Float64"), tables[1].astype("Int64")),
                     (vertices, pandas.Series([list(quad) for quad in quads], index=list("abcdef")))):
            same(self, fp.render(mesh, size=SIZE), cube)
        with_none = tables[1].astype("Int64")
        with_none.iloc[2, 1] = pandas.NA
        with self.assertRaisesRegex(TypeError, "faces: indices of object"):
            fp.render((vertices, with_none))

    @unittest.skipUnless(sys.platform == "linux", "elsewhere paths are text")
    def test_paths_need_not_be_text(self):
        vertices, quads = CUBE
        with tempfile.TemporaryDirectory() as folder:
            folder = os.path.join(os.fsencode(folder), b"\xff")
            os.mkdir(folder)
            path = os.path.join(folder, b"\xe9.obj")
            with open(os.path.join(folder, b"a.mtl"), "w") as file:
                file.write("newmtl a\nKd 0.5 0 0\n")
            with open(path, "w") as file:
                file.write("mtllib a.mtl\nusemtl a\n" + "".join("v %g %g %g\n" % tuple(v) for v in vertices)
                           + "".join("f %d %d %d %d\n" % tuple(quad + 1) for quad in quads))
            with open(os.path.join(folder, b"\xe9.toml"), "w") as file:
                file.write("image = { width = 8, height = 6 }\n[[object]]\nmesh = 'other.obj'\n")
            picture = measured(path)
            same(self, picture, measured(fp.Mesh(path)))
            self.assertFalse((picture == measured(CUBE)).all())
            with self.assertRaisesRegex(ValueError, "other.obj"):
                fp.render(os.path.join(folder, b"\xe9.toml"))
            os.rename(path, os.path.join(folder, b"other.obj"))
            self.assertEqual(fp.Scene(os.path.join(folder, b"\xe9.toml")).size, (8, 6))
            for read in (fp.render, fp.Mesh, fp.read_picture):
                with self.assertRaises(FileNotFoundError):
                    read(path)
            saved = os.path.join(folder, b"\xe9.png")
            picture.save(saved)
            same(self, fp.read_picture(saved), picture)
            self.assertTrue(fp.diff(saved, picture).equal)

    def test_meshes_and_scenes_are_pickled(self):
        vertices, quads = CUBE
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "a.obj")
            path.with_suffix(".mtl").write_text("newmtl a\nKd 1 0 0\nd 0.5\n")
            # Groups, parts, normals for some corners, a material for some faces.
            path.write_text("mtllib a.mtl\n" + "".join("v %g %g %g\n" % tuple(v) for v in vertices) + "vn 0 0 1\n"
                            + "s 1\no a\nf 1//1 2//1 4//1 3//1\nusemtl a\ns off\no b\nf 5 7 8 6\nhello\n")
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                meshes = [fp.Mesh(CUBE), fp.Mesh(vertices + 1e6, quads, colours=np.ones((6, 4)) / 2), fp.Mesh(path),
                          fp.Mesh("builtin:sphere"), fp.Mesh(vertices, quads, vertices[quads].reshape(-1, 3))]
                # Flat for lack of normals, and double-sided.
                room = HERE.parent / "fuzz/corpus/gltf/double-sided-room"
                path.with_suffix(".gltf").write_bytes(room.read_bytes())
                meshes.append(fp.Mesh(path.with_suffix(".gltf")))
            path.unlink()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for mesh in meshes:
                for copied in (pickle.loads(pickle.dumps(mesh)), copy.deepcopy(mesh)):
                    self.assertEqual(copied.warnings, mesh.warnings)
                    self.assertEqual(copied._mesh.stored, mesh._mesh.stored)
                    same(self, fp.render(copied, size=SIZE, up="z"), fp.render(mesh, size=SIZE, up="z"))
                    inside = {"camera": {"eye": [0.2, 0.1, 0.5], "target": [0.2, 0.1, 0], "fovy": 57}}
                    for keys in ({"normals": "averaged"}, {"scene": inside}):
                        same(self, fp.render(copied, size=SIZE, **keys), fp.render(mesh, size=SIZE, **keys))
                    self.assertEqual(fp.Scene(copied).notes, fp.Scene(mesh).notes)
            for scene in (fp.Scene("football", size=SIZE), fp.Scene(meshes[2], size=SIZE, view=(9, 9)),
                          fp.Scene("builtin:sphere", size=SIZE, look="compared")):
                same(self, pickle.loads(pickle.dumps(scene)).render(), scene.render())
        picture = pickle.loads(pickle.dumps(measured("builtin:sphere")))
        self.assertEqual((type(picture), picture.encoding, picture.background), (fp.Picture, "linear", (0, 0, 0)))

    def test_a_mesh_without_faces_is_an_error_that_says_so(self):
        for mesh in (([], []), (np.zeros((0, 3)), np.zeros((0, 3), int)), (CUBE[0], [])):
            self.assertEqual(len(fp.Mesh(*mesh).faces), 0)
            with self.assertRaisesRegex(ValueError, "no polygons"):
                fp.render(mesh, size=SIZE)

    def test_normals_may_belong_to_vertices_or_corners(self):
        vertices, faces = sphere()
        own = fp.render((vertices, faces, vertices), size=SIZE)
        same(self, own, fp.render((vertices, faces, 1e-200 * vertices), size=SIZE))
        same(self, own, fp.render((vertices, faces, vertices[faces]), size=SIZE))
        same(self, own, fp.render((vertices, faces, vertices[faces].reshape(-1, 3)), size=SIZE))
        self.assertFalse(fp.diff(own, fp.render((vertices, faces), size=SIZE, weight="uniform")).equal)
        same(self, fp.render((vertices, faces, vertices), size=SIZE, normals="averaged"),
             fp.render((vertices, faces), size=SIZE))

    def test_colours_are_lit(self):
        vertices, quads = CUBE
        matt = {"material": {"ka": 0, "kd": 0.6, "ks": 0}}
        red = fp.Mesh(vertices, quads, colours=np.tile((1.0, 0, 0), (8, 1)))
        lit = measured(red, scene=matt)
        self.assertTrue(lit[..., 0].any())
        self.assertFalse(lit[..., 1:3].any())
        # With and without alpha, by vertex and by face, as bytes and as floats: all draw the same picture.
        for colours, warned in (
            (np.tile((255, 0, 0), (8, 1)), []),
            (np.tile((1.0, 0, 0, 1), (6, 1)), []),
            (np.tile((1.0, 0, 0, 0.5), (6, 1)), ["transparency is not drawn, all surfaces are opaque"]),
            (np.tile(np.array((255, 0, 0, 7), np.uint8), (8, 1)), ["transparency is not drawn, all surfaces are opaque"]),
        ):
            self.assertEqual(told(lambda: fp.Mesh(vertices, quads, colours=colours)), warned)
            self.assertEqual(told(lambda: measured((vertices, quads), scene=matt, colours=colours)), warned)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                same(self, measured(fp.Mesh(vertices, quads, colours=colours), scene=matt), lit)
                same(self, measured((vertices, quads), scene=matt, colours=colours), lit)
        for mesh in ("builtin:cube", fp.Mesh(CUBE)):
            with self.assertRaisesRegex(TypeError, "expected True or False|expected arrays"):
                fp.render(mesh, colours=np.ones((8, 3)))
        for wrong in ("red", 1, [0.5]):
            with self.assertRaisesRegex(ValueError, "colours: an array of shape"):
                fp.render(CUBE, colours=wrong)
        same(self, measured(red, colours=True, scene=matt), lit)
        same(self, measured(red, colours=False), measured(CUBE))
        # In grey the shades are the same.
        white = measured(fp.Mesh(vertices, quads, colours=np.ones((8, 3))), scene=matt)
        self.assertTrue((white[..., 0] == lit[..., 0]).all() and (white[..., 1] == lit[..., 0]).all())

    def test_a_coloured_mesh_shows_its_own_colours(self):
        vertices, quads = CUBE
        # On the brown of meshes without colours, a white mesh would look brown.
        white = measured(fp.Mesh(vertices, quads, colours=np.ones((8, 3))))
        self.assertTrue((white[..., 0] == white[..., 1]).all() and (white[..., 1] == white[..., 2]).all())
        self.assertGreater(int(white[..., 0].max()), 100)

    def test_files_of_every_format_are_read(self):
        vertices, quads = CUBE
        threes = triangles(quads)
        body = "".join("%g %g %g\n" % tuple(vertex) for vertex in vertices)
        rows = "".join("4 %d %d %d %d\n" % tuple(quad) for quad in quads)
        facets = np.zeros(12, np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")]))
        facets["corners"] = vertices[threes]
        files = {
            "cube.obj": "".join(f"v {line}\n" for line in body.splitlines())
                        + "".join("f %d %d %d %d\n" % tuple(quad + 1) for quad in quads),
            "cube.off": f"OFF\n8 6 0\n{body}{rows}",
            "cube.ply": "ply\nformat ascii 1.0\nelement vertex 8\n"
                        "property float x\nproperty float y\nproperty float z\n"
                        f"element face 6\nproperty list uchar int vertex_indices\nend_header\n{body}{rows}",
            "cube.stl": b"\0" * 80 + np.uint32(12).tobytes() + facets.tobytes(),
            "no ending": b"\0" * 80 + np.uint32(12).tobytes() + facets.tobytes(),
        }
        with tempfile.TemporaryDirectory() as folder:
            for name, content in files.items():
                content = content.encode() if isinstance(content, str) else content
                path, packed = pathlib.Path(folder, name), pathlib.Path(folder, name + ".gz")
                path.write_bytes(content)
                packed.write_bytes(gzip.compress(content))
                is_soup = isinstance(files[name], bytes)
                given = {"mesh": (vertices, threes), "normals": 40} if is_soup else {"mesh": CUBE}
                expected = fp.render(size=SIZE, **given)
                with self.subTest(name):
                    same(self, fp.render(path, size=SIZE), expected)
                    same(self, fp.render(str(packed), size=SIZE), expected)
                    same(self, fp.render(fp.Mesh(path), size=SIZE), expected)

    def test_a_file_keeps_its_own_normals(self):
        for mesh in ("builtin:cube", fp.Mesh(CUBE)):
            with self.assertRaisesRegex(TypeError, "has its own faces, normals and colours: expected arrays"):
                fp.Mesh(mesh, normals=CUBE[0])

    def test_an_open_mesh_is_drawn_on_both_sides(self):
        vertices, quads = CUBE
        scene = fp.Scene((vertices, quads[:1]), view=(-1, 0, 0), size=SIZE)
        behind = fp.Scene((vertices, quads[:1]), view=(1, 0, 0), size=SIZE)
        self.assertIn("both sides", scene.notes[0])
        self.assertTrue(drawn(scene.render()).any() and drawn(behind.render()).any())
        only = fp.Scene((vertices, quads[:1]), view=(1, 0, 0), size=SIZE, scene={"cull": "back"})
        self.assertEqual(only.warnings, ["nothing is drawn: 1 polygon is seen from the culled side; "
                                         "try `scene={\"cull\": \"none\"}`"])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.assertFalse(drawn(only.render()).any())
        self.assertEqual(fp.Scene(CUBE, normals=40).notes, [])

    def test_warnings_about_a_mesh_point_to_the_line_that_draws_it(self):
        vertices, quads = CUBE
        inside_out = (vertices, quads[:, ::-1])
        for draw in (lambda: fp.render(inside_out, size=SIZE), lambda: fp.Scene(inside_out).render(size=SIZE)):
            found = told(draw)
            self.assertEqual(len(found), 1)
            self.assertRegex(found[0], "wound inside out.*, or try "
                                       "`scene={\"cull\": \"none\", \"two_sided\": True}`$")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "odd.obj")
            path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nhello\n")
            for read in (lambda: fp.render(path, size=SIZE), lambda: fp.Mesh(path),
                         lambda: fp.render(fp.Mesh(path), size=SIZE)):
                found = told(read)
                self.assertEqual(len(found), 1)
                self.assertRegex(found[0], "`hello` is not an OBJ statement")
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                self.assertEqual(fp.Scene(fp.Mesh(path)).warnings, fp.Mesh(path).warnings)

    def test_unusable_files_raise_errors_of_the_right_type(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "broken.obj")
            path.write_text("v 0 0 0\nf 1 2 3\n")
            for draw in (lambda name: fp.render(name, size=SIZE), fp.Mesh):
                with self.assertRaisesRegex(ValueError, "2: position index 2 is out of range"):
                    draw(path)
                with self.assertRaises(FileNotFoundError) as raised:
                    draw(str(path) + "x.obj")
                self.assertEqual(raised.exception.errno, 2)
                with self.assertRaises(IsADirectoryError):
                    draw(folder)
                with self.assertRaisesRegex(ValueError, "neither a file nor|cannot be read"):
                    draw("nothing\0.obj")
        with self.assertRaisesRegex(FileNotFoundError, "did you mean `teapot`"):
            fp.render("taepot")
        with self.assertRaisesRegex(ValueError, "did you mean `sphere`"):
            fp.render("builtin:spere")
        with self.assertRaisesRegex(ValueError, "did you mean `sphere`"):
            fp.Mesh("builtin:spere")


class OtherLibraries(unittest.TestCase):
    """Objects that look like those of other libraries, which need not be installed."""

    def trimesh(self, kind=None, **colours):
        vertices, quads = CUBE
        visual = types.SimpleNamespace(kind=kind, **colours)
        return types.SimpleNamespace(vertices=vertices, faces=triangles(quads), visual=visual)

    def test_trimesh(self):
        cube = fp.render((CUBE[0], triangles(CUBE[1])), size=SIZE)
        mesh = self.trimesh()
        same(self, fp.render(mesh, size=SIZE), cube)
        scene = types.SimpleNamespace(geometry={}, to_mesh=lambda: mesh)
        same(self, fp.render(scene, size=SIZE), cube)

    def test_trimesh_with_colours(self):
        by_vertex = np.random.default_rng(1).integers(0, 256, (8, 4), dtype=np.uint8)
        by_vertex[:, 3] = 255
        by_face = np.repeat(by_vertex[:6], 2, axis=0)
        for mesh, expected in (
            (self.trimesh("vertex", vertex_colors=by_vertex), 8),
            (self.trimesh("face", face_colors=by_face), 36),
        ):
            mesh = fp.Mesh(mesh)
            self.assertTrue(mesh._mesh.has_colours)
            self.assertEqual(len(mesh.vertices), expected)
        # Vertices at the same position share their normal.
        corners = fp.vertex_normals(mesh, per="corner")
        self.assertTrue(np.allclose(abs(corners), 3 ** -0.5, atol=1e-6))

    def test_pyvista(self):
        vertices, quads = CUBE
        threes = triangles(quads)
        flat = np.insert(quads, 0, 4, axis=1).ravel()
        mixed = np.concatenate([np.insert(quads[:3], 0, 4, axis=1).ravel(),
                                np.insert(triangles(quads[3:]), 0, 3, axis=1).ravel()])
        empty = np.zeros(0, int)
        for faces, strips, same_as in (
            (flat, empty, quads),
            (flat, None, quads),
            (np.insert(threes, 0, 3, axis=1).ravel(), empty, threes),
            (mixed, empty, [*quads[:3], *triangles(quads[3:])]),
            # The last face is a strip: 1 5 3 7 zigzags over it.
            (np.insert(quads[:5], 0, 4, axis=1).ravel(), np.array([4, 1, 5, 3, 7]),
             [*quads[:5], (1, 5, 3), (7, 3, 5)]),
        ):
            mesh = types.SimpleNamespace(points=vertices.astype(np.float32), faces=faces, strips=strips, point_data={})
            same(self, fp.render(mesh, size=SIZE), fp.render((vertices, same_as), size=SIZE))
            grid = types.SimpleNamespace(points=vertices, extract_surface=lambda mesh=mesh: mesh)
            same(self, fp.render(grid, size=SIZE), fp.render((vertices, same_as), size=SIZE))
        mesh.faces = np.array([3, 0, 1, 2, 4, 0, 1])
        with self.assertRaisesRegex(ValueError, "faces: entry 4 counts 4 corners"):
            fp.render(mesh)

    def test_pyvista_with_normals_and_colours(self):
        vertices, faces = sphere()
        data = {"Normals": vertices.astype(np.float32), "RGB": np.full((len(vertices), 3), 100, np.uint8)}
        mesh = types.SimpleNamespace(points=vertices, faces=np.insert(faces, 0, 3, axis=1).ravel(), point_data=data)
        taken = fp.Mesh(mesh)
        self.assertTrue(taken._mesh.has_normals and taken._mesh.has_colours)
        self.assertTrue(np.allclose(fp.vertex_normals(taken), vertices, atol=1e-6))

    def test_trimesh_with_materials(self):
        vertices, faces = CUBE[0], triangles(CUBE[1])
        grey = np.array([102, 102, 102, 255], np.uint8)
        simple = types.SimpleNamespace(
            kwargs={"kd": [0.8, 0.2, 0.1], "ks": [0.5, 0.5, 0.5], "ka": [0.1, 0.1, 0.1], "ns": 20.0},
            diffuse=np.array([204, 51, 26, 255], np.uint8), ambient=grey, specular=grey, glossiness=1.0, image=None)
        # As trimesh reads a file, and as a program makes it.
        plain = types.SimpleNamespace(kwargs={}, diffuse=np.array([255, 0, 0, 255], np.uint8), ambient=grey,
                                      specular=grey, glossiness=1.0, image=object())
        pbr = types.SimpleNamespace(baseColorFactor=np.array([0, 0, 255, 100], np.uint8), emissiveFactor=[0, 0, 1],
                                    alphaMode="BLEND", baseColorTexture=None)
        none = types.SimpleNamespace(baseColorFactor=None)
        several = types.SimpleNamespace(materials=[simple, plain])
        red_file = "Kd 0.8 0.2 0.1\nKs 0.5 0.5 0.5\nKa 0.1 0.1 0.1\nNs 20"
        no_texture, opaque, dark = ("textures are not drawn", "transparency is not drawn, all surfaces are opaque",
                                    "emission is not drawn")
        lines = ["v %g %g %g\n" % tuple(vertex) for vertex in vertices]
        rows = ["f %d %d %d\n" % tuple(face + 1) for face in faces]
        with tempfile.TemporaryDirectory() as folder:
            for material, of_faces, first, second, warned in (
                (simple, None, red_file, red_file, []),
                (plain, None, "Kd 1 0 0", "Kd 1 0 0", [no_texture]),
                (several, np.repeat([0, 1], 6), red_file, "Kd 1 0 0", [no_texture]),
                # A base colour, as the reader of glTF takes it.
                (pbr, None, *2 * ["Ka 0 0 0.1\nKd 0 0 0.8\nKs 0.1 0.1 0.1\nNs 32"], [opaque, dark]),
                (none, None, *2 * ["Ka 0.1 0.1 0.1\nKd 0.8 0.8 0.8\nKs 0.1 0.1 0.1\nNs 32"], []),
            ):
                visual = types.SimpleNamespace(kind="texture", material=material, face_materials=of_faces)
                mesh = types.SimpleNamespace(vertices=vertices, faces=faces, visual=visual)
                pathlib.Path(folder, "a.mtl").write_text(f"newmtl a\n{first}\nnewmtl b\n{second}\n")
                path = pathlib.Path(folder, "a.obj")
                path.write_text("".join(["mtllib a.mtl\n", *lines, "usemtl a\n", *rows[:6], "usemtl b\n", *rows[6:]]))
                dim = {"size": SIZE, "light": {"direction": (1, 2, 3), "intensity": 0.3}}
                with self.subTest(first):
                    self.assertEqual(told(lambda: same(self, fp.render(mesh, **dim), fp.render(path, **dim))), warned)

    def test_a_scene_of_trimesh_keeps_each_meshs_colours_and_materials(self):
        vertices, faces = CUBE[0], triangles(CUBE[1])
        red = types.SimpleNamespace(kind="texture", material=types.SimpleNamespace(baseColorFactor=[1.0, 0, 0, 1]))
        green = types.SimpleNamespace(kind="face", face_colors=np.tile((0, 255, 0, 255), (12, 1)))
        blue = types.SimpleNamespace(kind="vertex", vertex_colors=np.tile((0, 0, 255, 255), (8, 1)))
        meshes = [types.SimpleNamespace(vertices=vertices + (4 * i, 0, 0), faces=faces, visual=visual)
                  for i, visual in enumerate((red, green, blue))]
        path = types.SimpleNamespace(vertices=vertices, entities=[])
        scene = types.SimpleNamespace(geometry={}, dump=lambda: [*meshes, path])
        drawn = []
        self.assertEqual(told(lambda: drawn.append(measured(scene, view=(0, 0)))), ["points and lines are not drawn"])
        for third, channel in zip(np.split(drawn[0][30:42], 3, axis=1), range(3)):
            seen = third[third[..., 3] == 255].max(axis=0)
            self.assertEqual(int(seen[:3].argmax()), channel, seen)

    def meshio(self, *cells, points=CUBE[0], cell_data={}, **point_data):
        cells = [types.SimpleNamespace(type=kind, data=data) for kind, data in cells]
        return types.SimpleNamespace(points=points, cells=cells, point_data=point_data, cell_data=cell_data)

    def test_meshio(self):
        vertices, quads = CUBE
        cube = fp.render(CUBE, size=SIZE)
        lines = fp.Mesh(self.meshio(("quad", quads)))
        same(self, fp.render(lines, size=SIZE), cube)
        for kind, count, text in (("line", 2, "points and lines are not drawn"),
                                  ("vertex", 1, "points and lines are not drawn"),
                                  ("hexahedron64", 4, "cells of hexahedron64 are not drawn")):
            mesh = self.meshio((kind, quads[:, :count]), ("quad", quads))
            self.assertEqual(told(lambda: same(self, fp.render(mesh, size=SIZE), cube)), [text])
        mixed = self.meshio(("quad", quads[:3]), ("triangle", triangles(quads[3:])))
        same(self, fp.render(mixed, "flat", size=SIZE), fp.render(CUBE, "flat", size=SIZE))
        polygons = self.meshio(("polygon", [list(quad) for quad in quads]))
        same(self, fp.render(polygons, size=SIZE), cube)
        flat = self.meshio(("triangle", triangles(quads)[:1]), points=vertices[:, :2])
        self.assertEqual(fp.Mesh(flat).vertices.shape, (8, 3))
        with self.assertRaisesRegex(ValueError, "a mesh of line: expected triangles"):
            fp.render(self.meshio(("line", quads[:, :2])))

    def test_meshio_solids_show_their_surface(self):
        # Two cubes side by side share a face, which lies inside.
        points = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1, 2)], float)
        cell = np.array([0, 1, 4, 3, 6, 7, 10, 9])
        mesh = fp.Mesh(self.meshio(("hexahedron", np.array([cell, cell + 1])), points=points))
        self.assertEqual(len(mesh.faces), 10)
        self.assertEqual(fp.Scene(mesh, normals=40).notes, [])
        corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
        wedge = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)], float)
        pyramid = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1)])
        for kind, points, count in (("tetra", corners, 4), ("wedge", wedge, 5), ("pyramid", pyramid, 5)):
            with warnings.catch_warnings():
                # A cell that is inside out would cause a warning.
                warnings.simplefilter("error")
                mesh = fp.Mesh(self.meshio((kind, np.arange(len(points))[None]), points=points))
                self.assertEqual(len(mesh.faces), count)
                self.assertEqual(fp.Scene(mesh, normals=40).notes, [])

    def test_colours_of_cells(self):
        vertices, quads = CUBE
        colours = np.random.default_rng(1).integers(0, 256, (6, 3), dtype=np.uint8)
        expected = fp.render((vertices, quads), colours=colours, size=SIZE)
        flat = np.insert(quads, 0, 4, axis=1).ravel()
        more = np.concatenate([np.zeros((3, 3), np.uint8), colours])
        # pyvista counts points and lines before polygons. A strip has one colour.
        mesh = types.SimpleNamespace(points=vertices, faces=flat, strips=None, point_data={}, n_verts=1, n_lines=2,
                                     cell_data={"RGB": more})
        self.assertEqual(told(lambda: same(self, fp.render(mesh, size=SIZE), expected)),
                         ["points and lines are not drawn"])
        strip = types.SimpleNamespace(points=vertices, faces=flat[:25], strips=np.array([4, 1, 5, 3, 7]),
                                      point_data={}, cell_data={"RGB": colours})
        same(self, fp.render(strip, "flat", size=SIZE), fp.render((vertices, quads), "flat", colours=colours, size=SIZE))
        for cell_data in ({"RGB": [colours[:2], np.zeros((1, 3), np.uint8), colours[2:]]},
                          {name: [colours[:2, i], np.zeros(1, np.uint8), colours[2:, i]]
                           for i, name in enumerate(("red", "green", "blue"))}):
            mesh = self.meshio(("quad", quads[:2]), ("vertex", [[0]]), ("quad", quads[2:]), cell_data=cell_data)
            self.assertEqual(told(lambda: same(self, fp.render(mesh, size=SIZE), expected)),
                             ["points and lines are not drawn"])
        solid = self.meshio(("hexahedron", np.array([[0, 4, 6, 2, 1, 5, 7, 3]])), cell_data={"RGB": [colours[:1]]})
        same(self, fp.render(solid, size=SIZE), fp.render(CUBE, colours=np.tile(colours[:1], (8, 1)), size=SIZE))

    def test_colours_of_cells_are_not_taken_for_those_of_points(self):
        # A pyramid over a square has five points, four triangles and a square.
        points = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, 1)], float)
        faces = [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
        colours = np.array([(9, 9, 9), (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)], np.uint8)
        flat = np.concatenate([(len(face), *face) for face in faces])
        for mesh in (types.SimpleNamespace(points=points, faces=flat, strips=None, point_data={},
                                           cell_data={"RGB": colours}),
                     self.meshio(("quad", faces[:1]), ("triangle", faces[1:]), points=points,
                                 cell_data={"RGB": [colours[:1], colours[1:]]})):
            self.assertEqual(len(fp.Mesh(mesh).vertices), sum(map(len, faces)))

    def test_arrays_that_are_neither_colours_nor_normals_refuse_no_mesh(self):
        vertices, quads = CUBE
        flat = np.insert(quads, 0, 4, axis=1).ravel()
        cube = fp.render(CUBE, size=SIZE)
        for data, text in (
            ({"RGB": np.full((8, 3), 99.0)}, "`RGB` is not used as colours: row 0 is (99, 99, 99): expected 0 to 1"),
            ({"colors": np.zeros(8)}, "`colors` is not used as colours: an array of shape (8,): expected (n, 3) or (n, 4)"),
            ({"Normals": np.full((8, 3), np.nan)},
             "`Normals` is not used as normals: row 0 is (nan, nan, nan): expected finite numbers up to 3.4e38"),
            ({"Normals": np.zeros((8, 2))}, "`Normals` is not used as normals: an array of shape (8, 2): expected (n, 3)"),
        ):
            for mesh in (types.SimpleNamespace(points=vertices, faces=flat, strips=None, point_data=data),
                         self.meshio(("quad", quads), **data)):
                with self.subTest(text):
                    self.assertEqual(told(lambda: same(self, fp.render(mesh, size=SIZE), cube)), [text])
        mesh = types.SimpleNamespace(points=vertices, faces=flat, strips=None, point_data={},
                                     cell_data={"RGB": np.zeros((4, 3))})
        self.assertEqual(told(lambda: same(self, fp.render(mesh, size=SIZE), cube)),
                         ["`RGB` of cells is not used as colours: it has no row for each of 6 cells"])

    def test_colours_and_normals_of_meshio(self):
        vertices, faces = sphere()
        n = {"nx": vertices[:, 0], "ny": vertices[:, 1], "nz": vertices[:, 2]}
        c = {name: np.full(len(vertices), 9, np.uint8) for name in ("red", "green", "blue")}
        mesh = fp.Mesh(self.meshio(("triangle", faces), points=vertices, **n, **c))
        self.assertTrue(mesh._mesh.has_normals and mesh._mesh.has_colours)

    def test_arrays_that_are_not_colours_are_refused(self):
        vertices, quads = CUBE
        for colours, text in (
            (np.full((8, 3), 1.5), r"colours: row 0 is \(1.5, 1.5, 1.5\): expected 0 to 1"),
            (np.full((8, 3), -1), r"colours: row 0 is \(-1, -1, -1\): expected 0 to 255"),
            (np.zeros((5, 3)), "colours: 5 rows: expected one for each of 8 vertices or 6 faces"),
            (np.zeros(8), r"colours: an array of shape \(8,\)"),
        ):
            with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                fp.Mesh(vertices, quads, colours=colours)

    @unittest.skipUnless(importlib.util.find_spec("trimesh"), "trimesh is not installed")
    def test_trimesh_itself(self):
        import trimesh
        ball = trimesh.creation.icosphere(subdivisions=3)
        same(self, fp.render(ball, size=SIZE), fp.render((ball.vertices, ball.faces), size=SIZE))
        scene = trimesh.Scene([ball, trimesh.creation.box()])
        self.assertTrue(drawn(fp.render(scene, size=SIZE)).any())
        ball.visual.vertex_colors = np.tile(np.array([200, 200, 200, 255], np.uint8), (len(ball.vertices), 1))
        self.assertTrue(fp.Mesh(ball)._mesh.has_colours)
        with self.assertRaisesRegex(TypeError, "trimesh.PointCloud is no mesh"):
            fp.render(trimesh.PointCloud(ball.vertices))
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "a.mtl").write_text(
                "newmtl a\nKd 0.8 0.2 0.1\nKs 0.5 0.5 0.5\nKa 0.1 0.1 0.1\nNs 20\nnewmtl b\nKd 0.1 0.2 0.8\n")
            path = pathlib.Path(folder, "a.obj")
            rows = ["f %d %d %d\n" % tuple(face + 1) for face in triangles(CUBE[1])]
            path.write_text("".join(["mtllib a.mtl\n", *("v %g %g %g\n" % tuple(v) for v in CUBE[0]), "usemtl a\n",
                                     *rows[:6], "usemtl b\n", *rows[6:]]))
            same(self, fp.render(trimesh.load(path, process=False), size=SIZE), fp.render(path, size=SIZE))

    @unittest.skipUnless(importlib.util.find_spec("pyvista"), "pyvista is not installed")
    def test_pyvista_itself(self):
        import pyvista
        for mesh in (pyvista.Sphere(), pyvista.Cube(), pyvista.Plane(), pyvista.Sphere().strip(),
                     pyvista.Dodecahedron(), pyvista.ImageData(dimensions=(3, 4, 5))):
            self.assertTrue(drawn(fp.render(mesh, size=SIZE, up="z")).any())
        self.assertTrue(fp.Mesh(pyvista.Sphere())._mesh.has_normals)
        for mesh in (pyvista.Sphere().strip(), pyvista.ImageData(dimensions=(3, 4, 5)), pyvista.Cube()):
            mesh.cell_data["RGB"] = np.tile(np.array([255, 0, 0], np.uint8), (mesh.n_cells, 1))
            self.assertTrue(fp.Mesh(mesh)._mesh.has_colours)
            self.assertFalse(measured(mesh, scene={"material": {"ks": 0}})[..., 1:3].any())

    @unittest.skipUnless(importlib.util.find_spec("meshio"), "meshio is not installed")
    def test_meshio_itself(self):
        import meshio
        same(self, fp.render(meshio.Mesh(CUBE[0], {"quad": CUBE[1]}), size=SIZE), fp.render(CUBE, size=SIZE))


class Arguments(unittest.TestCase):
    def test_methods(self):
        names = fp.methods()
        self.assertIn("phong-rsqrt", names)
        self.assertLess(len(names), len(fp.methods(all=True)))
        truth = measured("builtin:sphere", "reference")
        for name in fp.methods(all=True):
            try:
                picture = measured("builtin:sphere", name)
            except ValueError as refused:
                self.assertRegex(str(refused), "the method is not for this frame")
                continue
            self.assertTrue((picture[..., 3] == truth[..., 3]).all(), name)
        # The default draws Phong's picture, up to rounding.
        fp.diff(truth, measured("builtin:sphere")).assert_below(2)
        for name in ("reference:phong", "reference:model=phong"):
            same(self, measured("builtin:sphere", name), truth)
        for name in ("reference:gouraud", "reference:model=gouraud"):
            fp.diff(measured("builtin:sphere", name), measured("builtin:sphere", "gouraud")).assert_below(2)
        for name, text in (
            ("fast-pong", "did you mean `fast-phong`"),
            ("reference:pong", "unknown closed form `pong`: did you mean `phong`"),
            ("fast-phong:steps=99", "steps"),
        ):
            with self.assertRaisesRegex(ValueError, text):
                fp.render("builtin:sphere", name, size=SIZE)
        with self.assertRaises(TypeError):
            fp.render("builtin:sphere", 3)

    def test_errors_name_the_wrong_argument(self):
        for arguments, kind, text in (
            ({"size": (0, 5)}, ValueError, "`size` is 0"),
            ({"size": 640}, TypeError, r"`size` is 640: expected \(width, height\)"),
            ({"size": (640.5, 480)}, TypeError, "`size` is 640.5: expected a whole number"),
            ({"size": (10**30, 5)}, ValueError, "`size` is"),
            ({"fovy": 10**400}, TypeError, "`fovy` is"),
            ({"method": "\udcff"}, ValueError, "`method` is .*: expected text in UTF-8"),
            ({"fovy": 180}, ValueError, "`fovy` is 180"),
            ({"fovy": "wide"}, TypeError, "`fovy` is 'wide': expected a number"),
            ({"fovy": float("nan")}, ValueError, "`fovy`"),
            ({"view": (0, 0, 0)}, ValueError, "`view`"),
            ({"view": (1, 2, 3, 4)}, ValueError, "`view` is .*expected 3 numbers"),
            ({"view": (0, 100)}, ValueError, "`view` is 100"),
            ({"up": "w"}, ValueError, "expected"),
            ({"up": (0.5, 0.3, 1)}, ValueError, "`up` is parallel to the line of sight"),
            ({"background": "white"}, TypeError, "`background` is 'white': expected 3 numbers"),
            ({"background": 2}, ValueError, "`background`"),
            ({"samples": 3}, ValueError, "`samples` is 3"),
            ({"normals": "smooth"}, ValueError, "."),
            ({"normals": 200}, ValueError, "`normals` is 200"),
            ({"light": (0, 0, 0)}, ValueError, "`light`"),
            ({"light": 3}, TypeError, "`light` is 3: expected a direction"),
            ({"scene": {"specula": 1}}, ValueError, "unknown key `specula`: expected one of"),
            ({"view": 3}, TypeError, "`view` is 3: expected 3 numbers"),
            ({"weight": "sine"}, ValueError, "expected one of `uniform`"),
            ({"weld": 2}, ValueError, "`weld` is 2: expected a fraction of the mesh's size"),
            ({"weld": "near"}, TypeError, "`weld` is 'near': expected a number"),
            ({"scene": "specular"}, TypeError, "`scene` is 'specular': expected a mapping"),
            ({"scene": {"image": 3}}, TypeError, "`scene` has 3 for `image`"),
            ({"scene": {"object": []}}, ValueError, "`scene` has the key `object`"),
            ({"scene": {"specular": object()}}, TypeError, "cannot be object"),
            ({"scene": {3: 1}}, TypeError, "cannot be int"),
            ({"wieght": 1}, TypeError, "unexpected keyword"),
            ({"method": 3}, TypeError, "`method` is 3: expected a str"),
            ({"look": 3}, TypeError, "`look` is 3: expected a str"),
            ({"weight": 3}, TypeError, "`weight` is 3: expected a str"),
            ({"light": "sun"}, TypeError, "`light` is 's': expected 3 numbers"),
            ({"light": {"direction": (1, 0)}}, ValueError, "`light`: expected three numbers"),
            ({"scene": {"ambient": "much"}}, ValueError, "`ambient`: expected"),
            ({"background": True}, TypeError, "`background` is True: expected a number"),
            ({"fovy": True}, TypeError, "`fovy` is True: expected a number"),
            ({"view": "ab"}, TypeError, "`view` is 'ab': expected 2 numbers"),
        ):
            with self.subTest(str(arguments)), self.assertRaisesRegex(kind, text):
                fp.render("builtin:cube", **{"size": SIZE, **arguments})

    def test_arguments_equal_the_keys_of_a_scene(self):
        draw = lambda **arguments: measured("builtin:teapot?res=4", **arguments)
        plain = draw()
        for a, b in (
            ({"fovy": 40}, {"scene": {"camera": {"fovy": 40}}}),
            ({"view": (30, 20)}, {"scene": {"camera": {"azimuth": 30, "elevation": 20}}}),
            ({"view": np.array([1, 2, 3])}, {"view": (2.0, 4.0, 6.0)}),
            ({"fovy": np.float32(40), "samples": np.int8(2)}, {"fovy": 40, "samples": 2}),
            ({"background": np.array(0.5)}, {"background": 0.5}),
            ({"light": (1, 0, 0)}, {"light": [{"direction": (1, 0, 0)}]}),
            ({"light": [(1, 0, 0), (0, 1, 0)]},
             {"scene": {"light": [{"direction": [1, 0, 0]}, {"direction": [0, 1, 0]}]}}),
            ({"light": []}, {"scene": {"light": []}}),
            ({"samples": 2}, {"scene": {"image": {"samples": 2}}}),
            ({"normals": 30}, {"normals": "crease=30"}),
            ({"up": "z"}, {"scene": {"camera": {"up": "z"}}}),
            ({"background": 0.5}, {"scene": {"image": {"background": 0.5, "alpha": "opaque"}}}),
        ):
            with self.subTest(str(a)):
                same(self, draw(**a), draw(**b))
                self.assertFalse(fp.diff(plain, draw(**a)).equal)

    def test_scene_files_are_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.toml")
            path.write_text('image = { width = 40, height = 30 }\n[[object]]\nmesh = "builtin:sphere"\n')
            scene = fp.Scene(path)
            self.assertEqual((scene.size, scene.render().shape), ((40, 30), (30, 40, 4)))
            self.assertEqual(fp.render(os.fsencode(path), size=(8, 6)).shape, (6, 8, 4))
            path.write_text('[[object]]\nmesh = "sphere"\n')
            with self.assertRaisesRegex(ValueError, r"scene.toml:2:8: .*did you mean `builtin:sphere`"):
                fp.render(path)


class KeptScenes(unittest.TestCase):
    def test_a_kept_scene_draws_what_render_draws(self):
        for mesh in (CUBE, "builtin:teapot?res=4", "football"):
            scene = fp.Scene(mesh, size=SIZE)
            for arguments in (
                {}, {"view": (40, 10)}, {"view": (0.2, 0.1, 1), "up": "z"}, {"fovy": 50}, {"size": (50, 90)},
                {"light": (0, 0, 1)}, {"samples": 2}, {},
            ):
                with self.subTest(f"{mesh} {arguments}"):
                    same(self, scene.render("phong-rsqrt", **arguments),
                         fp.render(mesh, "phong-rsqrt", **{"size": SIZE, **arguments}))

    def test_a_turntable_keeps_its_scale(self):
        # A cube is wider over its diagonal. Fitted, both views have the same width.
        scene = fp.Scene(CUBE, view=(0, 0), size=SIZE)
        width = lambda picture: int(drawn(picture).any(axis=0).sum())
        front, fitted = scene.render(), scene.render(view=(45, 0))
        kept = scene.render(view=(45, 0), keep_scale=True)
        self.assertAlmostEqual(width(kept), 2 ** 0.5 * width(front), delta=2)
        self.assertLess(width(fitted), width(kept))
        same(self, scene.render(view=(0, 0), keep_scale=True), front)

    def test_wrong_arguments_leave_the_scene_unchanged(self):
        scene = fp.Scene(CUBE, size=SIZE)
        before = scene.render()
        with self.assertRaisesRegex(ValueError, "`fovy` is 999"):
            scene.render(fovy=999)
        with self.assertRaisesRegex(ValueError, "did you mean"):
            scene.render("gourod")
        same(self, scene.render(), before)

    def test_threads_share_a_scene(self):
        scene = fp.Scene("builtin:torus", size=SIZE)
        views = [(10 * i, 5 * i) for i in range(8)]
        alone = [scene.render(view=view) for view in views]
        together = [None] * len(views)

        def draw(i):
            for _ in range(5):
                together[i] = scene.render(view=views[i])

        threads = [threading.Thread(target=draw, args=(i,)) for i in range(len(views))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for a, b in zip(alone, together):
            same(self, a, b)

    def test_pythons_lock_is_free_while_a_picture_is_drawn(self):
        begun, done = threading.Event(), []
        scene = fp.Scene("builtin:teapot", size=(1600, 1200))

        def draw():
            begun.set()
            scene.render("reference")
            done.append(True)

        interval = sys.getswitchinterval()
        # Threads are not interrupted here, so the other thread runs only if this one releases the lock.
        sys.setswitchinterval(1000)
        try:
            thread = threading.Thread(target=draw)
            thread.start()
            begun.wait()
            was_done = bool(done)
        finally:
            sys.setswitchinterval(interval)
        thread.join()
        self.assertFalse(was_done)

    @unittest.skipUnless(hasattr(os, "fork"), "no processes are forked here")
    def test_a_forked_process_draws_too(self):
        picture = fp.render("builtin:sphere", size=SIZE)
        self.assertEqual(forked(lambda: same(self, fp.render("builtin:sphere", size=SIZE), picture)), 0)

    @unittest.skipUnless(hasattr(os, "fork"), "no processes are forked here")
    def test_a_process_may_fork_while_a_thread_draws(self):
        scene, picture = fp.Scene("builtin:teapot", size=(320, 240)), fp.render("builtin:sphere", size=SIZE)
        vertices, faces = sphere(40, 80)
        with tempfile.TemporaryDirectory() as folder:
            saved = os.path.join(folder, "a.png")
            for busy, child in (
                (lambda: scene.render("reference"), lambda: scene.render(size=SIZE)),
                (lambda: scene.render("reference"), lambda: fp.render("builtin:sphere", size=SIZE)),
                (lambda: fp.Mesh(vertices, faces), lambda: fp.render((vertices, faces), size=SIZE)),
                (lambda: fp.diff(picture, picture), lambda: fp.diff(picture, picture)),
                (lambda: picture.save(saved), lambda: picture.save(saved + ".png")),
            ):
                is_done = threading.Event()

                def work():
                    while not is_done.is_set():
                        busy()

                thread = threading.Thread(target=work)
                thread.start()
                try:
                    for pause in (0.05, 0.1, 0.003):
                        time.sleep(pause)
                        self.assertEqual(forked(child), 0)
                finally:
                    is_done.set()
                    thread.join()

    @unittest.skipUnless(hasattr(signal, "raise_signal") and os.name == "posix", "no signals here")
    def test_ctrl_c_ends_a_picture_within_a_second(self):
        # A shell ignores SIGINT for programs that it starts in the background.
        self.addCleanup(signal.signal, signal.SIGINT, signal.getsignal(signal.SIGINT))
        signal.signal(signal.SIGINT, signal.default_int_handler)
        scene = fp.Scene("builtin:teapot", size=(2000, 1500))
        before = scene.render(size=SIZE)
        taken = []
        # On a machine that is busy with something else, one try may take longer.
        while len(taken) < 5 and min(taken, default=9) > 1:
            timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
            started = time.monotonic()
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                while time.monotonic() < started + 60:
                    scene.render("reference")
            taken.append(time.monotonic() - started - 0.2)
        self.assertLess(min(taken), 1)
        # Nothing waits for the picture that was given up.
        same(self, scene.render(size=SIZE), before)

    @unittest.skipUnless(sys.platform == "linux", "other systems do not say how much memory is free")
    def test_what_does_not_fit_is_a_memory_error(self):
        code = """if True:
            import numpy as np, resource, fastphong as fp
            fp.render("builtin:sphere", size=(64, 48))
            vertices, faces = np.random.default_rng(1).random((3000, 3)), np.arange(1500000, dtype=np.int32)
            scene = fp.Scene("builtin:sphere", size=(64, 48))
            used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
            _, most = resource.getrlimit(resource.RLIMIT_AS)
            resource.setrlimit(resource.RLIMIT_AS, (used + (150 << 20), most))
            for draw in (
                lambda: scene.render(size=(16384, 16384)),
                lambda: fp.render("builtin:sphere", size=(9000, 9000)),
                lambda: fp.render("builtin:sphere", "reference", size=(2000, 2000)),
                lambda: fp.render("builtin:torus?polygons=9000000"),
                lambda: fp.Scene((vertices, faces.reshape(-1, 3) % 3000), size=(64, 48)),
            ):
                try:
                    draw()
                except MemoryError as error:
                    print(str(error).split(" of memory, but ")[0])
            print(scene.render().shape)
        """
        ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=dict(os.environ))
        self.assertEqual(ran.returncode, 0, ran.stderr)
        lines = ran.stdout.splitlines()
        self.assertEqual(lines[-1], "(48, 64, 4)", ran.stdout)
        self.assertRegex(lines[0], "16384x16384: auto needs about .* GB")
        self.assertRegex(lines[1], "9000x9000: auto needs about .* MB")
        self.assertRegex(lines[2], "2000x2000: reference needs about .* GB")
        self.assertRegex(lines[3], "its meshes need about .* GB")
        self.assertRegex(lines[4], "mesh: its scene needs about .* MB")
        self.assertEqual(len(lines), 6, ran.stdout)


class Differences(unittest.TestCase):
    def test_equal_pictures(self):
        picture = measured("builtin:sphere")
        found = fp.diff(picture, picture)
        self.assertEqual((found.equal, found.max, found.rms, found.differing, found.worst), (True, 0, 0, 0, None))
        found.assert_below(1)
        with self.assertRaises(AssertionError):
            found.assert_below(0)

    def test_a_comparison_of_no_pixel_does_not_pass(self):
        a = np.zeros((6, 8, 4), np.uint8)
        fp.diff(a, a.copy()).assert_below(1)
        b = a.copy()
        b[..., 0] = 200
        found = fp.diff(a, b)
        self.assertEqual((found.equal, found.compared), (False, 0))
        with self.assertRaisesRegex(AssertionError, "nothing is compared"):
            found.assert_below(1)

    def test_pictures_that_differ(self):
        a = measured("builtin:sphere")
        b = a.copy()
        b[36, 48, 1] ^= 5
        b[0, 3] = (9, 9, 9, 255)
        found = fp.diff(a, b)
        self.assertEqual((found.equal, found.differing, found.coverage_mismatches), (False, 2, 1))
        self.assertEqual((found.max, found.worst), (255, (3, 0)))
        with self.assertRaisesRegex(AssertionError, r"255 grey levels apart, expected less than 2: \(0, 0, 0, 0\) and "
                                                    r"\(9, 9, 9, 255\) in column 3, row 0; <Difference: max 255"):
            found.assert_below(2)
        b[0, 3] = a[0, 3]
        found = fp.diff(a, b)
        step = abs(int(a[36, 48, 1]) - int(b[36, 48, 1]))
        self.assertAlmostEqual(found.max, step)
        covered = int((a[..., 3] > 0).sum())
        self.assertAlmostEqual(found.rms, (step ** 2 / (3 * covered)) ** 0.5)
        self.assertEqual(found.map.shape, (72, 96, 4))
        self.assertEqual(int((found.map[..., :3] > 0).any(axis=2).sum()), 1)
        self.assertTrue(found._repr_png_().startswith(b"\x89PNG"))
        self.assertIn("1 of", repr(found))
        for scale in (0, -1, float("nan")):
            with self.assertRaisesRegex(ValueError, "`scale` is .*: expected grey levels over 0"):
                found.draw(scale)
        with self.assertRaisesRegex(ValueError, "`levels` is not a number"):
            found.assert_below(float("nan"))

    def test_files_are_compared_as_they_are_stored(self):
        picture = measured("builtin:sphere", background=0.2)
        self.assertEqual(picture.encoding, "linear")
        with tempfile.TemporaryDirectory() as folder:
            path = lambda name: os.path.join(folder, name)
            # A saved picture states its encoding, so that it can be compared with one in another.
            shown = measured("builtin:sphere", background=0.2, scene={"image": {"encoding": "srgb"}})
            shown.save(path("srgb.png"))
            picture.save(path("linear.png"))
            self.assertEqual([fp.read_picture(path(f"{name}.png")).encoding for name in ("srgb", "linear")],
                             ["srgb", "linear"])
            # A linear level near black is many levels of sRGB.
            found = fp.diff(path("linear.png"), shown)
            self.assertEqual((found.encoding, fp.diff(path("linear.png"), picture).max), ("srgb", 0))
            self.assertLess(found.rms, 1.5)
            self.assertGreater(fp.diff(np.asarray(picture), np.asarray(shown)).rms, 20)
            # A plain array has the encoding of the other picture.
            self.assertTrue(fp.diff(np.asarray(picture), picture).equal)
            self.assertTrue(fp.diff(path("linear.png"), np.asarray(picture)).equal)
            # PFM holds linear floats, and is not clamped.
            picture.save(path("a.pfm"))
            # A float between 1/2 and 1 is rounded by at most 2 ** -25.
            self.assertLessEqual(fp.diff(picture, path("a.pfm")).max, 255 * 2 ** -25)
            shown.save(path("b.pfm"))
            # The slope of sRGB is at most 12.92.
            self.assertLessEqual(fp.diff(shown, path("b.pfm")).max, 12.92 * 255 * 2 ** -25)
            floats = lambda *values: b"PF\n2 1\n-1.0\n" + np.array(values, "<f4").tobytes()
            pathlib.Path(path("1.pfm")).write_bytes(floats(3, 1, 1, 0, 0, 0))
            pathlib.Path(path("2.pfm")).write_bytes(floats(2, 1, 1, 0, 0, 0))
            pathlib.Path(path("nan.pfm")).write_bytes(floats(np.nan, 1, 1, 0, 0, 0))
            self.assertEqual(fp.diff(path("1.pfm"), path("2.pfm")).max, 255)
            lost = fp.diff(path("1.pfm"), path("nan.pfm"))
            self.assertEqual((lost.not_finite, lost.worst), (1, (0, 0)))
            with self.assertRaisesRegex(AssertionError, "infinite or not a number in one of them"):
                lost.assert_below(1e9)
            self.assertEqual(told(lambda: fp.read_picture(path("1.pfm"))),
                             [path("1.pfm") + ": 1 channels are below 0, over 1 or not a number: they are clamped in 8 bits"])
            # 16 bits: a step of 1/65535 is not rounded away.
            for name, sample in (("a", b"\x80\x00"), ("b", b"\x80\x01")):
                pathlib.Path(path(f"{name}.ppm")).write_bytes(b"P6\n1 1\n65535\n" + 3 * sample)
            self.assertAlmostEqual(fp.diff(path("a.ppm"), path("b.ppm")).max, 255 / 65535)

    def test_what_the_program_warns_of_python_warns_of(self):
        picture = measured("builtin:sphere")
        opaque = measured("builtin:sphere", background=0)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.png")
            picture.save(path)
            with open(path, "rb") as file:
                png = file.read()
            # An animation of one frame: acTL stands before IDAT.
            chunk = b"acTL" + bytes([0, 0, 0, 1, 0, 0, 0, 0])
            chunk = bytes([0, 0, 0, 8]) + chunk + zlib.crc32(chunk).to_bytes(4, "big")
            at = png.index(b"IDAT") - 4
            animated = os.path.join(folder, "animated.png")
            with open(animated, "wb") as file:
                file.write(png[:at] + chunk + png[at:])
            for look in (lambda: fp.diff(animated, picture), lambda: fp.read_picture(animated)):
                self.assertRegex("\n".join(told(look)), "animated.png: .*(anim|picture)")
            self.assertEqual(told(lambda: fp.diff(path, picture)), [])
            # A file that states no encoding, against a linear picture.
            plain = os.path.join(folder, "plain.ppm")
            opaque.save(plain)
            self.assertEqual(told(lambda: fp.diff(opaque, plain)), [
                f"encodings: a states linear; {plain} states none, srgb is assumed; the linear picture was encoded as "
                "srgb, unrounded"])
            self.assertEqual(told(lambda: self.assertTrue(fp.diff(opaque, plain, assume="linear").equal)), [])
            self.assertEqual(told(lambda: fp.diff(picture, plain, assume="linear")), [
                f"{plain} has no alpha: a is drawn over the background that it states"])
            with self.assertRaisesRegex(ValueError, "`bright` is no encoding: expected linear or srgb"):
                fp.diff(picture, plain, assume="bright")

    def test_arrays_that_are_not_pictures_are_refused(self):
        picture = fp.render("builtin:sphere", size=SIZE)
        self.assertTrue(fp.diff(picture[..., :3], picture[..., :3]).equal)
        for a, b, kind, text in (
            (picture, picture[1:], ValueError, "96x72 and 96x71 pixels"),
            (picture, picture / 255.0, TypeError, "b: an array of float64: expected uint8"),
            (picture[..., 0], picture, ValueError, r"a: an array of shape \(72, 96\)"),
            (picture[:0], picture[:0], ValueError, "a: an array of shape"),
            ("no-such-file.png", picture, FileNotFoundError, "no-such-file.png"),
        ):
            with self.subTest(text), self.assertRaisesRegex(kind, text):
                fp.diff(a, b)


class Normals(unittest.TestCase):
    def test_normals_of_a_cube_are_symmetric(self):
        vertices, quads = CUBE
        faces = triangles(quads)
        exact = vertices / 3 ** 0.5
        # Normals are rounded to f32, by half a unit in the last place of values below 1.
        self.assertLess(abs(fp.vertex_normals((vertices, faces)) - exact).max(), 2 ** -24)
        self.assertGreater(abs(fp.vertex_normals((vertices, faces), weight="uniform") - exact).max(), 0.1)

    def test_creases_have_a_normal_for_each_corner(self):
        corners = fp.vertex_normals(CUBE, 40, per="corner")
        self.assertEqual((corners.shape, corners.dtype), ((24, 3), np.dtype(np.float32)))
        self.assertTrue((np.sort(abs(corners), axis=1) == (0, 0, 1)).all())
        with self.assertRaisesRegex(ValueError, "the corners at vertex 0 have different normals: ask for per='corner'"):
            fp.vertex_normals(CUBE, 40)
        for arguments, text in (
            ({"per": "face"}, "`per` is 'face'"),
            ({"weight": "sine"}, "expected one of `uniform`"),
            ({"normals": "smooth"}, "expected one of `averaged`"),
            ({"normals": "crease=x"}, "expected crease=DEGREES"),
            ({"normals": -1}, "`normals` is -1: expected "),
        ):
            with self.assertRaisesRegex(ValueError, text):
                fp.vertex_normals(CUBE, **arguments)

    def test_vertices_that_no_face_uses_have_no_normal(self):
        vertices, quads = CUBE
        more = np.concatenate([vertices, [(9, 9, 9)]])
        self.assertEqual(fp.vertex_normals((more, quads)).shape, (9, 3))
        self.assertFalse(fp.vertex_normals((more, quads))[8].any())


class Notes(unittest.TestCase):
    def test_a_scene_warns_once_when_it_is_first_drawn(self):
        lit = {"light": {"position": (0, 0, 0)}, "size": SIZE}
        scene = fp.Scene("builtin:sphere", **lit)
        for draw in (lambda: fp.render("builtin:sphere", **lit), lambda: scene.render(view=(9, 9))):
            found = told(draw)
            self.assertEqual(len(found), 2)
            self.assertRegex(found[0], "stands inside the closed surface")
            self.assertRegex(found[1], "the light does not reach anything visible")
        self.assertEqual(scene.warnings, found)
        self.assertEqual(told(scene.render), [])

    def test_notes_name_arguments_that_help(self):
        vertices, faces = sphere()
        soup = vertices[faces].reshape(-1, 3) * (1 + 1e-7 * np.arange(3 * len(faces))[:, None] % 3e-7)
        soup = (soup, np.arange(len(soup)).reshape(-1, 3))
        coloured = fp.Mesh(*CUBE, colours=np.ones((8, 3)))
        for mesh, before, said, after in (
            (CUBE, {}, "`normals=40` keeps these sharp", {"normals": 40}),
            (soup, {}, "were merged: `weld=1e-6`", {"weld": 1e-6}),
            (coloured, {"colours": False, "normals": 40}, "`colours=True` uses them", {"colours": True}),
            ((*CUBE, CUBE[0]), {"normals": "averaged"}, "`normals=\"auto\"` uses them", {"normals": "auto"}),
            (CUBE, {"normals": 40, "fovy": 40, "scene": {"camera": {"eye": (0, 0, 9), "target": (0, 0, 20)}}},
             "`scene={\"camera\": {\"fit\": 0.8}}` brings all of them into view",
             {"scene": {"camera": {"fit": 0.8}}}),
        ):
            with self.subTest(said):
                notes = lambda **arguments: (lambda scene: scene.warnings + scene.notes)(fp.Scene(mesh, **arguments))
                self.assertEqual(len([text for text in notes(**before) if said in text]), 1, notes(**before))
                self.assertEqual([text for text in notes(**{**before, **after}) if said in text], [])

    def test_weld_merges_vertices(self):
        vertices, faces = sphere()
        # Every triangle has its own corners, which rounding has moved apart.
        moved = vertices[faces].reshape(-1, 3) * (1 + 1e-5 * np.random.default_rng(1).random((3 * len(faces), 1)))
        soup = (moved, np.arange(len(moved)).reshape(-1, 3))
        normals = fp.vertex_normals(soup, weld=1e-4)
        self.assertLess(abs(normals - fp.vertex_normals((vertices, faces))[faces].reshape(-1, 3)).max(), 1e-3)
        self.assertGreater(abs(fp.vertex_normals(soup) - normals).max(), 1e-2)
        with self.assertRaisesRegex(ValueError, "`weld` is 2: expected a fraction"):
            fp.vertex_normals(soup, weld=2)
        flat, smooth, whole = measured(soup), measured(soup, weld=1e-4), measured((vertices, faces))
        self.assertLess(fp.diff(whole, smooth).rms, fp.diff(whole, flat).rms)

    def test_the_doors_situations(self):
        path = ROOT / "tests" / "doors.json"
        for situation in json.loads(path.read_text(encoding="utf-8")):
            with self.subTest(situation["name"]), tempfile.TemporaryDirectory() as folder:
                for name, text in situation["files"].items():
                    pathlib.Path(folder, name).write_text(text, encoding="utf-8")
                name = situation["input"]
                scene = fp.Scene(os.path.join(folder, name) if name in situation["files"] else name)
                found = scene.warnings + scene.notes
                for note in situation["notes"]:
                    self.assertEqual(sum(note["says"] in text for text in found), 1, (note, found))
                for text in found:
                    self.assertNotIn("--", text)


def run_cells(cells):
    """Run pieces of code in order in one module, as a notebook does, and return the module."""
    module = {"__name__": "__main__", "display": lambda *shown: None}
    for number, cell in enumerate(cells, 1):
        tree = ast.parse(cell, f"<cell {number}>")
        with contextlib.redirect_stdout(io.StringIO()):
            exec(compile(tree, f"<cell {number}>", "exec"), module)
    return module


class Documents(unittest.TestCase):
    def test_notebooks_run(self):
        notebooks = sorted((HERE / "examples").glob("*.ipynb"))
        self.assertTrue(notebooks)
        for path in notebooks:
            cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
            cells = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
            self.in_a_new_folder(cells)

    def test_the_code_of_the_page_runs(self):
        page = ROOT / "docs" / "python.md"
        if not page.is_file():
            self.skipTest("docs/python.md is not here")
        blocks = re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.S | re.M)
        self.assertGreater(len(blocks), 3)
        shown = fp.read_picture(ROOT / "docs" / "images" / "python" / "knot.png")
        # The page shows what its first lines draw. Other machines may round differently.
        self.in_a_new_folder(blocks, lambda: fp.diff("knot.png", shown).assert_below(1.5))

    def in_a_new_folder(self, cells, check=lambda: None):
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                run_cells(cells)
                check()
            finally:
                os.chdir(before)

    def test_the_stubs_name_every_item_of_the_module(self):
        package = pathlib.Path(fp.__file__).parent
        for name, module in [("_fastphong", fp._fastphong)]:
            tree = ast.parse((package / f"{name}.pyi").read_text(encoding="utf-8"))
            stubs = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
            # A type that begins with an underscore exists only in the stubs.
            stubs = {stub: node for stub, node in stubs.items() if not stub.startswith("_")}
            self.assertEqual(set(stubs), {n for n in dir(module) if not n.startswith("__")})
            for stub, node in stubs.items():
                there = getattr(module, stub)
                if isinstance(node, ast.ClassDef):
                    for member in node.body:
                        if isinstance(member, ast.FunctionDef):
                            self.assertTrue(hasattr(there, member.name), f"{stub}.{member.name}")


if __name__ == "__main__":
    unittest.main()
