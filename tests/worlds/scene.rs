//! Strategies for scene files: settings, camera, lights, objects.

use super::mesh::{builtin_name, mtl, obj, used_materials};
use super::numbers::{any_size, colour, number, size, text, triple};
use super::world::World;
use proptest::prelude::*;
use std::fmt::Write;

/// The largest width and height of a picture.
const SIDES: [u32; 2] = [64, 48];

/// Keys of a scene file and their possible values. A key may also be absent.
const CHOICES: &[(&str, &[&str])] = &[
    ("interpolation", &["'perspective'"]),
    ("viewer", &["'local'"]),
    ("specular", &["'blinn'", "'phong'"]),
    ("shininess_for", &["'phong'", "'blinn'"]),
    ("specular_gate", &["'ungated'", "'weighted'"]),
    ("visibility", &["'draw-order'", "'painter'"]),
    ("depth_bits", &["16", "24"]),
    ("depth", &["'per-sample'"]),
    ("painter_key", &["'farthest'"]),
    ("two_sided", &["true"]),
];

/// Returns exponents: powers of two, which have a fast path, and any others up to 10⁴.
pub fn shininess() -> BoxedStrategy<f64> {
    prop_oneof![
        3 => (0..=7).prop_map(|n| 2.0f64.powi(n)),
        1 => Just(0.0),
        4 => size(-1.0..4.0),
    ]
    .boxed()
}

/// Returns the lines of all settings whose values are words.
fn choices() -> BoxedStrategy<String> {
    let each: Vec<_> = CHOICES
        .iter()
        .map(|(_, values)| prop_oneof![2 => Just(0), 1 => 1..=values.len()])
        .collect();
    // Half of all polygons face away.
    let cull =
        prop_oneof![4 => Just(""), 5 => Just("cull = 'none'\n"), 1 => Just("cull = 'front'\n")];
    (each, prop::bool::weighted(0.1), cull)
        .prop_map(|(numbers, is_cube, cull)| {
            let mut text = String::from(cull);
            for ((key, values), number) in CHOICES.iter().zip(numbers) {
                // These two settings exclude each other.
                let is_taken = number > 0 && !(is_cube && *key == "interpolation");
                if is_taken {
                    let _ = writeln!(text, "{key} = {}", values[number - 1]);
                }
            }
            if is_cube {
                text.push_str("clipping = 'ndc-cube'\n");
            }
            text
        })
        .boxed()
}

fn image() -> BoxedStrategy<String> {
    let samples = prop_oneof![6 => Just(1u32), 1 => Just(2), 1 => Just(4), 1 => Just(8)];
    let words = (any::<bool>(), prop::option::weighted(0.3, colour()));
    (1..=SIDES[0], 1..=SIDES[1], samples, words)
        .prop_map(|(width, height, samples, (is_srgb, background))| {
            // The time depends on samples, not on pixels.
            let [width, height] = [width, height].map(|side| side.div_ceil(samples));
            let mut text = format!("[image]\nwidth = {width}\nheight = {height}\n");
            if samples > 1 {
                let _ = writeln!(text, "samples = {samples}");
            }
            if is_srgb {
                text.push_str("encoding = 'srgb'\n");
            }
            if let Some(colour) = background {
                let _ = writeln!(text, "background = {:?}", colour.map(|c| c.min(1.0)));
            }
            text
        })
        .boxed()
}

/// Returns cameras. Some are fitted around the objects, others stand anywhere, also inside an
/// object or looking away from it.
fn camera() -> BoxedStrategy<String> {
    let projection = prop_oneof![
        2 => (20.0..100.0).prop_map(|fovy| format!("fovy = {fovy:?}\n")),
        1 => prop_oneof![0.001..0.1, 150.0..179.999]
            .prop_map(|fovy: f64| format!("fovy = {fovy:?}\n")),
        2 => Just(String::new()),
        1 => size(-3.0..3.0).prop_map(|half| format!("half_height = {half:?}\n")),
    ];
    let fitted = (
        prop::option::of(triple(number())),
        prop::option::weighted(0.3, size(-2.0..1.5)),
    )
        .prop_map(|(direction, fit)| {
            let mut text = String::new();
            if let Some(direction) = direction.filter(|&d| d != [0.0; 3]) {
                let _ = writeln!(text, "direction = {}", self::text(direction));
            }
            if let Some(fit) = fit {
                let _ = writeln!(text, "fit = {fit:?}");
            }
            text
        });
    let eye = triple(
        prop_oneof![3 => number(), 2 => number().prop_map(|n| 4.0 * n), 1 => any_size()].boxed(),
    );
    let standing = (
        eye,
        prop::option::of(triple(number())),
        prop::option::weighted(0.3, triple(number())),
    )
        .prop_map(|(eye, target, up)| {
            let mut text = format!("eye = {}\n", self::text(eye));
            if let Some(target) = target.filter(|&target| target != eye) {
                let _ = writeln!(text, "target = {}", self::text(target));
            }
            if let Some(up) = up.filter(|&up| up != [0.0; 3]) {
                let _ = writeln!(text, "up = {}", self::text(up));
            }
            text
        });
    let planes = prop_oneof![
        6 => Just(String::new()),
        1 => (size(-2.0..0.5), size(0.0..2.0))
            .prop_map(|(near, depth)| format!("near = {near:?}\nfar = {:?}\n", near + depth)),
        1 => (size(-8.0..-2.0), size(2.0..8.0))
            .prop_map(|(near, far)| format!("near = {near:?}\nfar = {far:?}\n")),
        1 => (size(-60.0..-2.0), size(2.0..15.9))
            .prop_map(|(near, far)| format!("near = {near:?}\nfar = {far:?}\n")),
    ];
    let place = prop_oneof![2 => fitted.boxed(), 1 => standing.boxed()];
    (place, projection, planes)
        .prop_map(|(place, projection, planes)| {
            let is_conflict = place.contains("fit") && projection.contains("half_height");
            let projection = if is_conflict { "" } else { &projection };
            format!("[camera]\n{place}{projection}{planes}")
        })
        .boxed()
}

fn light() -> BoxedStrategy<String> {
    let direction = triple(number())
        .prop_map(|d| if d == [0.0; 3] { [0.0, 0.0, 1.0] } else { d })
        .prop_map(|d| format!("direction = {}\n", text(d)));
    let falloff = prop_oneof![
        3 => Just(String::new()),
        1 => size(-3.0..2.0).prop_map(|k| format!("attenuation = {k:?}\n")),
        1 => Just("falloff = 'inverse'\n".to_owned()),
        1 => Just("falloff = 'inverse-square'\n".to_owned()),
    ];
    let position = prop_oneof![
        3 => triple(number()).boxed(),
        2 => triple(number()).prop_map(|p| p.map(|c| 5.0 * c)).boxed(),
        1 => triple(any_size()).boxed(),
    ];
    let position =
        (position, falloff).prop_map(|(p, falloff)| format!("position = {}\n{falloff}", text(p)));
    let shine = (
        prop::option::of(colour()),
        prop::option::weighted(0.2, size(-2.0..2.0)),
    );
    (
        prop_oneof![3 => direction.boxed(), 2 => position.boxed()],
        shine,
    )
        .prop_map(|(place, (colour, intensity))| {
            let mut text = format!("[[light]]\n{place}");
            if let Some(colour) = colour {
                let _ = writeln!(text, "colour = {}", self::text(colour));
            }
            if let Some(intensity) = intensity {
                let _ = writeln!(text, "intensity = {intensity:?}");
            }
            text
        })
        .boxed()
}

fn lights() -> BoxedStrategy<String> {
    let several = |count| prop::collection::vec(light(), count).prop_map(|all| all.concat());
    prop_oneof![
        2 => Just(String::new()),
        4 => several(1..2),
        3 => several(2..6),
        1 => several(6..12),
    ]
    .boxed()
}

fn material() -> BoxedStrategy<String> {
    (colour(), colour(), colour(), shininess())
        .prop_map(|(ka, kd, ks, n)| {
            format!("{{ ka = {ka:?}, kd = {kd:?}, ks = {ks:?}, shininess = {n:?} }}")
        })
        .boxed()
}

fn transform() -> BoxedStrategy<String> {
    let not_zero = || number().prop_map(|n| if n == 0.0 { -1.0 } else { n });
    let scale = prop_oneof![
        2 => [not_zero(), not_zero(), not_zero()].prop_map(text),
        1 => size(-3.0..3.0).prop_map(|size| format!("{size:?}")),
    ];
    let turn = (triple(number()), -360.0..360.0).prop_filter_map("an axis", |(axis, angle)| {
        (axis != [0.0; 3])
            .then(|| format!("rotate = {{ axis = {}, angle = {angle:?} }}\n", text(axis)))
    });
    let parts = (
        prop::option::weighted(0.4, scale),
        prop::option::weighted(0.4, turn),
        prop::option::weighted(0.4, triple(any_size())),
    )
        .prop_map(|(scale, turn, translate)| {
            let scale = scale.map_or(String::new(), |scale| format!("scale = {scale}\n"));
            let translate = translate.map(|t| format!("translate = {}\n", text(t)));
            scale + &turn.unwrap_or_default() + &translate.unwrap_or_default()
        });
    let row = || [number(), number(), number(), number()];
    let matrix = [row(), row(), row()].prop_map(|rows| format!("matrix = {rows:?}\n"));
    prop_oneof![
        4 => Just(String::new()),
        4 => parts.boxed(),
        1 => matrix.boxed(),
    ]
    .boxed()
}

fn object() -> BoxedStrategy<String> {
    let mesh = prop_oneof![1 => builtin_name().boxed(), 2 => Just("world.obj".to_owned()).boxed()];
    let normals = prop_oneof![
        3 => Just(String::new()),
        1 => Just("normals = 'given'\n".to_owned()),
        1 => (0.0..180.0).prop_map(|degrees| format!("crease = {degrees:?}\n")),
    ];
    (
        mesh,
        normals,
        transform(),
        prop::option::weighted(0.4, material()),
    )
        .prop_map(|(mesh, normals, transform, material)| {
            let material = material
                .map(|material| format!("material = {material}\n"))
                .unwrap_or_default();
            format!("[[object]]\nmesh = '{mesh}'\n{normals}{transform}{material}")
        })
        .boxed()
}

/// Returns worlds.
pub fn worlds() -> BoxedStrategy<World> {
    let objects = prop_oneof![
        4 => prop::collection::vec(object(), 1..2),
        1 => prop::collection::vec(object(), 2..4),
    ];
    let ambient = prop::option::weighted(0.3, colour());
    let given = prop::option::weighted(0.3, material());
    let settings = (choices(), ambient, given, image(), camera(), lights());
    (settings, objects, obj(), mtl())
        .prop_map(|(settings, objects, mesh, materials)| {
            let (mut scene, ambient, given, image, camera, lights) = settings;
            if let Some(ambient) = ambient {
                let _ = writeln!(scene, "ambient = {}", text(ambient));
            }
            if let Some(given) = given {
                let _ = writeln!(scene, "material = {given}");
            }
            if lights.is_empty() {
                scene.push_str("light = []\n");
            }
            let objects = objects.concat();
            let scene = format!("{scene}{image}{camera}{lights}{objects}");
            let is_used = scene.contains("world.obj");
            let mesh = if is_used { mesh } else { String::new() };
            World {
                scene,
                materials: used_materials(&materials, &mesh),
                mesh,
            }
        })
        .boxed()
}
