//! The table of built-in shapes. Everything that the program knows about them stands here.

use super::{Builtin, ParameterKind, Resolution, ShapeParameter, Values};
use crate::mesh::shapes::{self, ParameterGrid, Terrain, Topology};

/// The most cells along one direction. All but thin shapes reach the polygon limit of a mesh first.
const MOST: f64 = (1 << 20) as f64;

const fn real(
    name: &'static str,
    default: f64,
    min: f64,
    max: f64,
    doc: &'static str,
) -> ShapeParameter {
    ShapeParameter {
        name,
        kind: ParameterKind::Real,
        default,
        min,
        max,
        doc,
    }
}

const fn integer(
    name: &'static str,
    default: u32,
    min: u32,
    max: f64,
    doc: &'static str,
) -> ShapeParameter {
    ShapeParameter {
        kind: ParameterKind::Integer,
        ..real(name, default as f64, min as f64, max, doc)
    }
}

const fn switch(name: &'static str, default: bool, doc: &'static str) -> ShapeParameter {
    ShapeParameter {
        kind: ParameterKind::Bool,
        ..real(name, default as u8 as f64, 0.0, 1.0, doc)
    }
}

const TRIANGLES: ShapeParameter = switch("triangles", false, "split quads into two triangles");
const SEGMENTS: ShapeParameter = integer("segments", 64, 3, MOST, "cells around");
const RINGS: ShapeParameter = integer("rings", 32, 2, MOST, "bands from pole to pole");
const BALL: Resolution = Resolution {
    rows: "rings",
    columns: Some(("segments", 2.0)),
};
const INNER: ShapeParameter = real(
    "inner",
    0.4,
    0.05,
    0.95,
    "radius of the corners between the points",
);

/// Returns the polygon count of a grid. `columns` and `rows` name the parameters that hold its
/// resolution.
fn grid(values: &Values, topology: Topology, columns: &str, rows: &str) -> u64 {
    ParameterGrid::new(
        topology,
        values.integer(columns),
        values.integer(rows),
        values.switch("triangles"),
    )
    .polygon_count()
}

fn ball(values: &Values) -> u64 {
    grid(values, Topology::Ball, "segments", "rings")
}

fn tube(values: &Values) -> u64 {
    grid(values, Topology::Tube, "segments", "sides")
}

fn one(_: &Values) -> u64 {
    1
}

/// All built-in shapes, in the order in which they are listed.
pub const BUILTINS: &[Builtin] = &[
    Builtin {
        name: "sphere",
        doc: "the unit sphere",
        parameters: &[SEGMENTS, RINGS, TRIANGLES],
        resolution: Some(BALL),
        polygon_count: ball,
        build: |v| {
            shapes::sphere(
                v.integer("segments"),
                v.integer("rings"),
                v.switch("triangles"),
            )
        },
    },
    Builtin {
        name: "bumpy",
        doc: "the unit sphere with smooth bumps",
        parameters: &[
            real("amplitude", 0.15, 0.0, 0.5, "height of the bumps"),
            real(
                "frequency",
                8.0,
                0.0,
                100.0,
                "bumps, in radians per unit of length",
            ),
            integer("segments", 192, 3, MOST, "cells around"),
            integer("rings", 96, 2, MOST, "bands from pole to pole"),
            TRIANGLES,
        ],
        resolution: Some(BALL),
        polygon_count: ball,
        build: |v| {
            let (amplitude, frequency) = (v.real("amplitude"), v.real("frequency"));
            shapes::bumpy(
                v.integer("segments"),
                v.integer("rings"),
                amplitude,
                frequency,
                v.switch("triangles"),
            )
        },
    },
    Builtin {
        name: "superellipsoid",
        doc: "a rounded box, through a sphere, to a rounded double pyramid",
        parameters: &[
            real(
                "e1",
                0.4,
                0.05,
                1.95,
                "shape along y: toward 0 square, 1 round, toward 2 pointed",
            ),
            real(
                "e2",
                0.4,
                0.05,
                1.95,
                "shape around y: toward 0 square, 1 round, toward 2 pointed",
            ),
            integer("segments", 128, 3, MOST, "cells around"),
            integer("rings", 64, 2, MOST, "bands from pole to pole"),
            TRIANGLES,
        ],
        resolution: Some(BALL),
        polygon_count: ball,
        build: |v| {
            let (segments, rings) = (v.integer("segments"), v.integer("rings"));
            shapes::superellipsoid(
                v.real("e1"),
                v.real("e2"),
                segments,
                rings,
                v.switch("triangles"),
            )
        },
    },
    Builtin {
        name: "torus",
        doc: "a ring around the z axis",
        parameters: &[
            real("major", 1.0, 0.1, 10.0, "radius of the ring"),
            real("minor", 0.4, 0.001, 10.0, "radius of its tube"),
            SEGMENTS,
            integer("sides", 32, 3, MOST, "cells around the tube"),
            TRIANGLES,
        ],
        resolution: Some(Resolution {
            rows: "sides",
            columns: Some(("segments", 2.0)),
        }),
        polygon_count: tube,
        build: |v| {
            let (segments, sides) = (v.integer("segments"), v.integer("sides"));
            shapes::torus(
                v.real("major"),
                v.real("minor"),
                segments,
                sides,
                v.switch("triangles"),
            )
        },
    },
    Builtin {
        name: "knot",
        doc: "a tube along the (p, q) torus knot; p and q without a common factor",
        parameters: &[
            integer("p", 2, 1, 16.0, "turns around the axis"),
            integer("q", 3, 1, 16.0, "turns around the torus"),
            real("radius", 0.16, 0.01, 0.35, "radius of the tube"),
            integer("segments", 384, 32, MOST, "cells along the tube"),
            integer("sides", 24, 3, MOST, "cells around the tube"),
            TRIANGLES,
        ],
        resolution: Some(Resolution {
            rows: "sides",
            columns: Some(("segments", 16.0)),
        }),
        polygon_count: tube,
        build: |v| {
            let (segments, sides) = (v.integer("segments"), v.integer("sides"));
            shapes::knot(
                v.integer("p"),
                v.integer("q"),
                segments,
                sides,
                v.real("radius"),
                v.switch("triangles"),
            )
        },
    },
    Builtin {
        name: "teapot",
        doc: "the Utah teapot, from its Bézier patches",
        parameters: &[
            integer("res", 12, 1, 1024.0, "cells along each side of a patch"),
            switch(
                "bottom",
                true,
                "with the bottom that the original did not have",
            ),
            TRIANGLES,
        ],
        resolution: Some(Resolution {
            rows: "res",
            columns: None,
        }),
        polygon_count: |v| {
            shapes::teapot_polygons(v.integer("res"), v.switch("bottom"), v.switch("triangles"))
        },
        build: |v| shapes::teapot(v.integer("res"), v.switch("bottom"), v.switch("triangles")),
    },
    Builtin {
        name: "corrugated",
        doc: "a wavy sheet, whose inflections linear normals hide",
        parameters: &[
            real("waves", 3.0, 0.0, 1000.0, "whole waves across"),
            real("amplitude", 0.15, 0.0, 10.0, "height of the waves"),
            integer("segments", 48, 1, MOST, "cells across the waves"),
            integer("rows", 16, 1, MOST, "cells along the waves"),
            TRIANGLES,
        ],
        resolution: Some(Resolution {
            rows: "rows",
            columns: Some(("segments", 3.0)),
        }),
        polygon_count: |v| grid(v, Topology::Sheet, "segments", "rows"),
        build: |v| {
            let (segments, rows) = (v.integer("segments"), v.integer("rows"));
            shapes::corrugated(
                v.real("waves"),
                v.real("amplitude"),
                segments,
                rows,
                v.switch("triangles"),
            )
        },
    },
    Builtin {
        name: "terrain",
        doc: "hills, y upward",
        parameters: &[
            real("amplitude", 0.25, 0.0, 10.0, "height of the largest hills"),
            real(
                "frequency",
                3.0,
                0.0,
                1000.0,
                "how many of the largest hills stand along a side",
            ),
            integer(
                "octaves",
                4,
                1,
                16.0,
                "kinds of hills, each half as large as the one before",
            ),
            integer("seed", 1, 0, u32::MAX as f64, "which terrain"),
            integer("segments", 128, 1, MOST, "cells from left to right"),
            integer("rows", 128, 1, MOST, "cells from front to back"),
            switch(
                "colours",
                false,
                "vertex colours by height: grass, rock, snow",
            ),
            TRIANGLES,
        ],
        resolution: Some(Resolution {
            rows: "rows",
            columns: Some(("segments", 1.0)),
        }),
        polygon_count: |v| grid(v, Topology::Sheet, "segments", "rows"),
        build: |v| {
            let terrain = Terrain {
                amplitude: v.real("amplitude"),
                frequency: v.real("frequency"),
                octaves: v.integer("octaves"),
                seed: v.integer("seed") as u64,
            };
            let mut mesh = shapes::terrain(
                terrain,
                v.integer("segments"),
                v.integer("rows"),
                v.switch("triangles"),
            )?;
            if v.switch("colours") {
                mesh.colour_by_height();
            }
            Ok(mesh)
        },
    },
    Builtin {
        name: "cube",
        doc: "the cube from -1 to 1",
        parameters: &[
            integer("res", 1, 1, 2048.0, "cells along each edge"),
            TRIANGLES,
        ],
        resolution: Some(Resolution {
            rows: "res",
            columns: None,
        }),
        polygon_count: |v| {
            let res = v.integer("res") as u64;
            6 * res * res * (1 + v.switch("triangles") as u64)
        },
        build: |v| shapes::cube(v.integer("res"), v.switch("triangles")),
    },
    Builtin {
        name: "prism",
        doc: "a star-shaped solid: two concave caps and a quad on each side",
        parameters: &[
            integer("points", 5, 2, MOST, "points of the star"),
            INNER,
            real("depth", 0.6, 0.001, 10.0, "distance between the caps"),
        ],
        resolution: None,
        polygon_count: |v| 2 + 2 * v.integer("points") as u64,
        build: |v| shapes::prism(v.integer("points"), v.real("inner"), v.real("depth")),
    },
    Builtin {
        name: "gear",
        doc: "a gear: two concave caps of many sides and a quad on each side",
        parameters: &[
            integer("teeth", 12, 3, MOST, "teeth"),
            real("inner", 0.8, 0.05, 0.99, "radius of the gaps"),
            real("depth", 0.4, 0.001, 10.0, "distance between the caps"),
        ],
        resolution: None,
        polygon_count: |v| 2 + 4 * v.integer("teeth") as u64,
        build: |v| shapes::gear(v.integer("teeth"), v.real("inner"), v.real("depth")),
    },
    Builtin {
        name: "triangle",
        doc: "one triangle",
        parameters: &[],
        resolution: None,
        polygon_count: one,
        build: |_| shapes::triangle(),
    },
    Builtin {
        name: "polygon",
        doc: "one regular polygon",
        parameters: &[integer("sides", 6, 3, MOST, "sides")],
        resolution: None,
        polygon_count: one,
        build: |v| shapes::polygon(v.integer("sides")),
    },
    Builtin {
        name: "star",
        doc: "one concave, star-shaped polygon",
        parameters: &[integer("points", 5, 2, MOST, "points of the star"), INNER],
        resolution: None,
        polygon_count: one,
        build: |v| shapes::star(v.integer("points"), v.real("inner")),
    },
    Builtin {
        name: "comb",
        doc: "one concave polygon that a scan line crosses many times",
        parameters: &[integer("teeth", 8, 1, MOST, "teeth")],
        resolution: None,
        polygon_count: one,
        build: |v| shapes::comb(v.integer("teeth")),
    },
    Builtin {
        name: "letters",
        doc: "the word SHINE: five concave polygons",
        parameters: &[],
        resolution: None,
        polygon_count: |_| 5,
        build: |_| shapes::letters(),
    },
    Builtin {
        name: "figure5",
        doc: "the lecture's square whose shading changes when it is turned; for a light from +z",
        parameters: &[real(
            "angle",
            0.0,
            -360.0,
            360.0,
            "degrees, counter-clockwise",
        )],
        resolution: None,
        polygon_count: one,
        build: |v| shapes::figure5(v.real("angle")),
    },
];
